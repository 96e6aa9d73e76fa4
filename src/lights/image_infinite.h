// Radiance from infinitely far away by direction, from an image.
#pragma once

#include "lights/infinite.h"
#include "lights/light_data.h"

namespace etd {

struct ImageInfiniteLight {
  const EnvironmentMap* map;
  Frame axes;  // of the map, in the world
  float scale = 1;

  static const ModelDecl& decl() { return infinite_decl(); }
  static bool is_meant(const ParamReader& p) { return p.given("filename") != nullptr; }
  static std::optional<ImageInfiniteLight> create(const ParamReader& p, const LightContext& context) {
    reject_radiance_beside_file(p);
    const std::optional<Frame> axes = light_axes(context.to_world, p);
    const EnvironmentMap* map = read_environment(p, context);
    if (!map || !axes) return {};
    const float scale =
        emission_scale(p, "illuminance", p.number("illuminance") > 0 ? map->irradiance_up() : Spectrum());
    return ImageInfiniteLight{map, *axes, scale};
  }

  bool is_infinite() const { return true; }
  bool is_delta() const { return false; }
  std::optional<LightSample> sample_li(Point3, Vec2 u, const ShadingContext&, LightSampling sampling) const {
    const std::optional<Vec3> w = map->sample(u, sampling);
    if (!w) return {};
    // Value and density are looked up again, at the direction as it was rounded: whoever meets the same direction
    // otherwise finds the same texel.
    LightSample s;
    s.wi = normalize(axes.to_world(*w));
    const Vec3 rounded = axes.to_local(s.wi);
    s.radiance = map->value(rounded) * scale;
    s.pdf = map->pdf(rounded, sampling);
    if (!(s.pdf > 0.0f) || is_black(s.radiance)) return {};
    return s;
  }
  float pdf_li(Point3, Vec3 wi, const SurfacePoint*, const ShadingContext&, LightSampling sampling) const {
    return map->pdf(axes.to_local(wi), sampling);
  }
  Spectrum emitted(const SurfacePoint*, Vec3 w, const ShadingContext&, Point3) const {
    return map->value(axes.to_local(-w)) * scale;
  }
  Spectrum power() const { return map->integral() * (kPi * scale); }
  static std::optional<LightBounds> bounds() { return {}; }
};

}  // namespace etd
