// The same intensity in all directions from one point.
#pragma once

#include "core/warp.h"
#include "lights/point_lights.h"
#include "textures/resolve.h"

namespace etd {

struct IsotropicIntensity {
  Spectrum value;

  static const ModelDecl& decl() {
    static const ModelDecl d{Family::kLight,
                             "point",
                             "The same light in all directions from one point.",
                             {intensity_param(), position_param(), scale_param(), power_param()}};
    return d;
  }
  static std::optional<PointLight<IsotropicIntensity>> create(const ParamReader& p, const LightContext& context) {
    const Spectrum value = emission_value(p, "I");
    return PointLight<IsotropicIntensity>{light_position(p, context),
                                          {value * emission_scale(p, "power", value * (4.0f * kPi))}};
  }

  Spectrum intensity(Vec3, const ShadingContext&) const { return value; }
  std::optional<Vec3> sample(Vec2 u) const { return sample_sphere_uniform(u); }
  float pdf(Vec3) const { return pdf_sphere_uniform(); }
  Spectrum power() const { return value * (4.0f * kPi); }
  void bound(LightBounds& b) const { b.intensity = luminance(value); }
};

}  // namespace etd
