// The same radiance from every direction of an infinite sphere around the scene.
#pragma once

#include "core/warp.h"
#include "lights/light.h"
#include "textures/resolve.h"

namespace etd {

struct ConstantInfiniteLight {
  Spectrum radiance;

  static const ModelDecl& decl() {
    static const ModelDecl d{Family::kLight,
                             "infinite",
                             "Light from all directions, from infinitely far away.",
                             {{.name = "L",
                               .type = ParamType::kSpectrum,
                               .default_value = 1.0,
                               .min = 0,
                               .unit = "W/(m^2 sr)",
                               .doc = "Radiance of every direction."},
                              {.name = "scale", .default_value = 1.0, .min = 0, .doc = "Factor on the radiance."}}};
    return d;
  }
  static ConstantInfiniteLight create(const ParamReader& p) {
    return {emission_value(p, "L") * static_cast<float>(p.number("scale"))};
  }

  bool is_infinite() const { return true; }
  std::optional<LightSample> sample_li(Point3, Vec2 u) const {
    return LightSample{sample_sphere_uniform(u), radiance, pdf_sphere_uniform(), {}};
  }
  float pdf_li(Point3, Vec3, const SurfacePoint*) const { return pdf_sphere_uniform(); }
  Spectrum emitted(const SurfacePoint*, Vec3) const { return radiance; }
  Spectrum power() const { return radiance * (4.0f * sqr(kPi)); }
};

}  // namespace etd
