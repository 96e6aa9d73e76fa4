// Parallel light from one direction, infinitely far away: a sun without width.
#pragma once

#include "lights/light.h"
#include "lights/light_params.h"
#include "textures/resolve.h"

namespace etd {

struct DistantLight {
  Vec3 direction;       // to the light
  Spectrum irradiance;  // on a surface that faces it

  static const ModelDecl& decl() {
    static const ModelDecl d{Family::kLight,
                             "distant",
                             "Parallel light from one direction, infinitely far away.",
                             {{.name = "L",
                               .type = ParamType::kSpectrum,
                               .default_value = 1.0,
                               .min = 0,
                               .unit = "W/m^2",
                               .doc = "Irradiance on a surface that faces the light."},
                              {.name = "from",
                               .type = ParamType::kPoint3,
                               .default_value = std::vector<double>{0, 0, 0},
                               .doc = "A point that the light passes first."},
                              {.name = "to",
                               .type = ParamType::kPoint3,
                               .default_value = std::vector<double>{0, 0, 1},
                               .doc = "A point that it passes later: it travels along to - from."},
                              scale_param(),
                              illuminance_param("that faces the light")}};
    return d;
  }
  static std::optional<DistantLight> create(const ParamReader& p, const LightContext& context) {
    const std::optional<Vec3d> along = light_direction(p);
    const Spectrum irradiance = emission_value(p, "L");
    const float scale = emission_scale(p, "illuminance", irradiance);
    if (!along) return {};
    return DistantLight{to_float(normalize(context.to_world.vector(-*along))), irradiance * scale};
  }

  bool is_infinite() const { return true; }
  bool is_delta() const { return true; }
  std::optional<LightSample> sample_li(Point3, Vec2, const ShadingContext&, LightSampling) const {
    if (is_black(irradiance)) return {};
    return LightSample{direction, irradiance, 1.0f, {}, true};
  }
  float pdf_li(Point3, Vec3, const SurfacePoint*, const ShadingContext&, LightSampling) const { return 0.0f; }
  Spectrum emitted(const SurfacePoint*, Vec3, const ShadingContext&, Point3) const { return Spectrum(); }
  Spectrum power() const { return irradiance * kPi; }
  static std::optional<LightBounds> bounds() { return {}; }
};

}  // namespace etd
