// Surfaces that emit to all directions alike, from one side or both.
#pragma once

#include "core/frame.h"
#include "core/warp.h"
#include "lights/area_emission.h"
#include "lights/area_light.h"
#include "shapes/placement.h"

namespace etd {

template <class Surface>
struct DiffuseAreaLight {
  AreaEmission emission;
  Surface surface;
  Spectrum mean;  // of the radiance over the surface

  // `points`: along each side of the square of samples from which the mean of an image is taken.
  DiffuseAreaLight(const AreaEmission& e, const Surface& s, int points = 1)
      : emission(e), surface(s), mean(mean_radiance(e, s, points)) {}

  DiffuseAreaLight scaled(float factor) const {
    DiffuseAreaLight light = *this;
    light.emission.radiance *= factor;
    light.mean *= factor;
    return light;
  }

  bool is_infinite() const { return false; }
  bool is_delta() const { return emission.invisible; }

  Spectrum emitted(const SurfacePoint* s, Vec3 w, const ShadingContext&, Point3) const {
    return emission.invisible ? Spectrum() : emission.towards(*s, w);
  }

  std::optional<LightSample> sample_li(Point3 p, Vec2 u, const ShadingContext&, LightSampling) const {
    std::optional<LightSample> sample(std::in_place);  // filled in place: it is large
    LightSample& s = *sample;
    float pdf_area = 0;
    const auto seen = surface.seen_from(p);
    s.on_light = seen ? seen->sample(u) : surface.sample(u, pdf_area);
    const Vec3 d = s.on_light.p - p;
    const float d2 = dot(d, d);
    if (!(d2 > 0.0f)) return sample.reset(), sample;
    s.wi = d * (1.0f / std::sqrt(d2));
    s.radiance = emission.towards(s.on_light, -s.wi);
    s.is_delta = emission.invisible;
    s.pdf =
        seen ? static_cast<float>(1.0 / seen->solid_angle()) : to_solid_angle(pdf_area, d2, dot(s.on_light.ng, s.wi));
    if (is_black(s.radiance) || !(s.pdf > 0.0f) || !std::isfinite(s.pdf)) sample.reset();
    return sample;
  }

  float pdf_li(Point3 p, Vec3 wi, const SurfacePoint* s, const ShadingContext& context, LightSampling) const {
    if (is_black(emitted(s, -wi, context, p))) return 0.0f;
    if (const auto seen = surface.seen_from(p)) return static_cast<float>(1.0 / seen->solid_angle());
    const Vec3 d = s->p - p;
    const float pdf = to_solid_angle(surface.pdf_area(*s), dot(d, d), dot(s->ng, wi));
    return std::isfinite(pdf) ? pdf : 0.0f;
  }

  // Uniform over the area in the light's own space, and as the cosine around the normal in the world, on either side
  // with the same probability if both emit. `at`: where that space is, null when it is the world.
  std::optional<EmissionSample> sample_le(Vec2 u_position, Vec2 u_direction, const ShadingContext&,
                                          const Placement* at) const {
    EmissionSample s;
    s.on_light = surface.sample(u_position, s.pdf_position);
    if (at) {
      s.pdf_position /= area_stretch(at->to_world, at->to_object, s.on_light.ng);
      s.on_light = to_world(s.on_light, *at);
    }
    const bool back = emission.two_sided && u_direction.x >= 0.5f;
    if (emission.two_sided) u_direction.x = 2.0f * u_direction.x - (back ? 1.0f : 0.0f);
    const Vec3 n = back ? -s.on_light.ng : s.on_light.ng;
    const Vec3 w = normalize(Frame::from_z(n).to_world(sample_hemisphere_cosine(u_direction)));
    s.cosine = dot(n, w);
    s.pdf_direction = pdf_emitted(s.on_light, w);
    s.radiance = emission.towards(s.on_light, w);
    s.ray = {offset_origin(s.on_light, w), w};
    const float pdf = s.pdf_position * s.pdf_direction;
    if (is_black(s.radiance) || !(pdf > 0.0f) || !std::isfinite(pdf)) return {};
    return s;
  }

  EmissionDensity pdf_le(const SurfacePoint* s, Vec3 w, const ShadingContext&, Point3, const Placement* at) const {
    const float direction = pdf_emitted(*s, w);
    if (!at) return {surface.pdf_area(*s), direction};
    const SurfacePoint own = to_object(*s, *at);
    return {surface.pdf_area(own) / area_stretch(at->to_world, at->to_object, own.ng), direction};
  }

  Spectrum power() const { return mean * (kPi * surface.area() * (emission.two_sided ? 2.0f : 1.0f)); }
  // A surface with normals to all sides shows a quarter of its area on average.
  std::optional<LightBounds> bounds() const {
    const SurfaceBounds s = surface.bounds();
    LightBounds b{s.box, s.normals};
    b.cone.both = b.cone.both || emission.two_sided;
    b.intensity = luminance(mean) * surface.area() * (b.cone.is_everything() ? 0.25f : 1.0f);
    return b;
  }

 private:
  // Density per solid angle of emitted directions.
  float pdf_emitted(const SurfacePoint& s, Vec3 w) const {
    const float cosine = dot(s.ng, w);
    return emission.two_sided ? 0.5f * pdf_hemisphere_cosine(std::abs(cosine)) : pdf_hemisphere_cosine(cosine);
  }

  // Density per area to density per solid angle: times d^2 / |cos|.
  static float to_solid_angle(float pdf_area, float distance2, float cosine) {
    return pdf_area * distance2 / std::abs(cosine);
  }

  static Spectrum mean_radiance(const AreaEmission& e, const Surface& surface, int points) {
    if (!e.image) return e.radiance;
    double sum[3] = {0, 0, 0}, weights = 0;
    for (int i = 0; i < points * points; ++i) {
      const auto along = [&](int k) { return (static_cast<float>(k) + 0.5f) / static_cast<float>(points); };
      float pdf_area = 0;
      const SurfacePoint s = surface.sample({along(i % points), along(i / points)}, pdf_area);
      const Spectrum value = e.at(s.uv);
      for (int c = 0; c < 3; ++c) sum[c] += static_cast<double>(value[c] / pdf_area);
      weights += static_cast<double>(1.0f / pdf_area);
    }
    const auto mean = [&](int c) { return static_cast<float>(sum[c] / weights); };
    const Spectrum found = Spectrum::rgb(mean(0), mean(1), mean(2));
    // A bright spot between the points would never be chosen for sampling if the mean were 0.
    return is_black(found) ? e.radiance * 1e-4f : found;
  }
};

// The model that scenes name.
struct DiffuseArea {
  template <class Surface>
  using On = DiffuseAreaLight<Surface>;

  static const ModelDecl& decl();
  static AreaLights create(const ParamReader& p, const AreaLightContext& context);
};

}  // namespace etd
