// The same radiance from every direction of an infinite sphere around the scene.
#pragma once

#include "core/warp.h"
#include "lights/infinite.h"
#include "lights/light.h"
#include "textures/resolve.h"

namespace etd {

struct ConstantInfiniteLight {
  Spectrum radiance;

  static const ModelDecl& decl() { return infinite_decl(); }
  static std::optional<ConstantInfiniteLight> create(const ParamReader& p, const LightContext&) {
    const Spectrum radiance = emission_value(p, "L");
    return ConstantInfiniteLight{radiance * emission_scale(p, "illuminance", radiance * kPi)};
  }

  bool is_infinite() const { return true; }
  bool is_delta() const { return false; }
  std::optional<LightSample> sample_li(Point3, Vec2 u, const ShadingContext&, LightSampling) const {
    return LightSample{sample_sphere_uniform(u), radiance, pdf_sphere_uniform(), {}};
  }
  float pdf_li(Point3, Vec3, const SurfacePoint*, const ShadingContext&, LightSampling) const {
    return pdf_sphere_uniform();
  }
  Spectrum emitted(const SurfacePoint*, Vec3, const ShadingContext&, Point3) const { return radiance; }
  Spectrum power() const { return radiance * (4.0f * sqr(kPi)); }
  static std::optional<LightBounds> bounds() { return {}; }
};

}  // namespace etd
