// Surfaces that emit to all directions alike, from one side or both.
#pragma once

#include "lights/area_emission.h"
#include "lights/light.h"
#include "lights/light_params.h"
#include "lights/light_surfaces.h"
#include "textures/resolve.h"

namespace etd {

inline const ModelDecl& diffuse_area_decl() {
  static const ModelDecl d{
      Family::kAreaLight,
      "diffuse",
      "Emits the same radiance to all directions from every point of a shape.",
      {{.name = "L",
        .type = ParamType::kSpectrum,
        .default_value = 1.0,
        .min = 0,
        .unit = "W/(m^2 sr)",
        .doc = "Emitted radiance."},
       filename_param("Image of the radiance over the shape's uv, instead of L; (0, 0) is its lower left corner.",
                      false),
       scale_param(),
       power_param(),
       {.name = "twosided",
        .type = ParamType::kBool,
        .default_value = false,
        .doc = "Emit from both sides, not just from that of the surface normal."}}};
  return d;
}

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

  Spectrum emitted(const SurfacePoint* s, Vec3 w) const {
    return emission.invisible ? Spectrum() : emission.towards(*s, w);
  }

  std::optional<LightSample> sample_li(Point3 p, Vec2 u, LightSampling) const {
    LightSample s;
    float pdf_area = 0;
    const auto seen = surface.seen_from(p);
    s.on_light = seen ? seen->sample(u) : surface.sample(u, pdf_area);
    const Vec3 d = s.on_light.p - p;
    const float d2 = dot(d, d);
    if (!(d2 > 0.0f)) return {};
    s.wi = d * (1.0f / std::sqrt(d2));
    s.radiance = emission.towards(s.on_light, -s.wi);
    s.is_delta = emission.invisible;
    s.pdf =
        seen ? static_cast<float>(1.0 / seen->solid_angle()) : to_solid_angle(pdf_area, d2, dot(s.on_light.ng, s.wi));
    if (is_black(s.radiance) || !(s.pdf > 0.0f) || !std::isfinite(s.pdf)) return {};
    return s;
  }

  float pdf_li(Point3 p, Vec3 wi, const SurfacePoint* s, LightSampling) const {
    if (is_black(emitted(s, -wi))) return 0.0f;
    if (const auto seen = surface.seen_from(p)) return static_cast<float>(1.0 / seen->solid_angle());
    const Vec3 d = s->p - p;
    const float pdf = to_solid_angle(surface.pdf_area(*s), dot(d, d), dot(s->ng, wi));
    return std::isfinite(pdf) ? pdf : 0.0f;
  }

  Spectrum power() const { return mean * (kPi * surface.area() * (emission.two_sided ? 2.0f : 1.0f)); }

 private:
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

}  // namespace etd
