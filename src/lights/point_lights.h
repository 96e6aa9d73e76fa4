// Lights whose radiant intensity leaves a single point: what the isotropic, spot, goniometric and projection lights
// share. Each of them is a distribution of intensity over directions.
#pragma once

#include "lights/light.h"
#include "lights/light_params.h"
#include "shapes/placement.h"

namespace etd {

// Intensity: Spectrum intensity(Vec3 w, const ShadingContext&) in W/sr along the unit direction w in the world,
// Spectrum power() in W; std::optional<Vec3> sample(Vec2 u), a unit direction or nothing of a black light, and float
// pdf(Vec3 w), its density; void bound(LightBounds&) const, which sets all but the box.
template <class Intensity>
struct PointLight {
  Point3 position;
  Intensity emission;

  static const ModelDecl& decl() { return Intensity::decl(); }
  static std::optional<PointLight> create(const ParamReader& p, const LightContext& context) {
    return Intensity::create(p, context);
  }

  bool is_infinite() const { return false; }
  bool is_delta() const { return true; }

  std::optional<LightSample> sample_li(Point3 p, Vec2, const ShadingContext& context, LightSampling) const {
    const Vec3 d = position - p;
    const float d2 = dot(d, d);
    if (!(d2 > 0.0f)) return {};
    LightSample s;
    s.wi = d * (1.0f / std::sqrt(d2));
    s.radiance = emission.intensity(-s.wi, context) * (1.0f / d2);
    s.pdf = 1.0f;
    s.is_delta = true;
    // A normal towards p lets the shadow ray end as close to the light as rounding allows.
    s.on_light.p = position;
    s.on_light.ng = s.on_light.ns = -s.wi;
    if (is_black(s.radiance)) return {};
    return s;
  }
  float pdf_li(Point3, Vec3, const SurfacePoint*, const ShadingContext&, LightSampling) const { return 0.0f; }
  Spectrum emitted(const SurfacePoint*, Vec3, const ShadingContext&, Point3) const { return Spectrum(); }
  // `at`: where the light's own space is, null when it is the world.
  std::optional<EmissionSample> sample_le(Vec2, Vec2 u_direction, const ShadingContext& context,
                                          const Placement* at) const {
    const std::optional<Vec3> own = emission.sample(u_direction);
    if (!own) return {};
    EmissionSample s;
    s.on_light.p = position;
    s.on_light.ng = s.on_light.ns = *own;
    if (at) s.on_light = to_world(s.on_light, *at);
    s.ray = {s.on_light.p, s.on_light.ng};
    // Value and density are looked up for the direction as it was rounded.
    const Vec3 rounded = to_own(s.ray.d, at);
    s.radiance = emission.intensity(rounded, context);
    s.pdf_position = 1.0f;
    s.pdf_direction = emission.pdf(rounded);
    if (is_black(s.radiance) || !(s.pdf_direction > 0.0f) || !std::isfinite(s.pdf_direction)) return {};
    return s;
  }
  EmissionDensity pdf_le(const SurfacePoint*, Vec3 w, const ShadingContext&, Point3, const Placement* at) const {
    return {1.0f, emission.pdf(to_own(w, at))};
  }
  Spectrum power() const { return emission.power(); }
  std::optional<LightBounds> bounds() const {
    LightBounds b;
    b.box.extend(to_double(position));
    emission.bound(b);
    return b;
  }

 private:
  static Vec3 to_own(Vec3 w, const Placement* at) { return at ? normalize(at->to_object.vector(w)) : w; }
};

inline ParamDecl intensity_param() {
  return {.name = "I",
          .type = ParamType::kSpectrum,
          .default_value = 1.0,
          .min = 0,
          .unit = "W/sr",
          .doc = "Radiant intensity."};
}
inline ParamDecl position_param() {
  return {.name = "from",
          .type = ParamType::kPoint3,
          .default_value = std::vector<double>{0, 0, 0},
          .unit = "m",
          .doc = "Where the light is."};
}

// Returns where the light's "from" is, or its origin, in the recentred world.
inline Point3 light_position(const ParamReader& p, const LightContext& context) {
  if (!p.decl().find("from")) return to_float(context.to_world.point({0, 0, 0}));
  const std::vector<double> from = p.numbers("from");
  return to_float(context.to_world.point({from[0], from[1], from[2]}));
}

}  // namespace etd
