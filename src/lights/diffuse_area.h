// Surfaces that emit the same radiance to every direction of one side or both.
#pragma once

#include "lights/light.h"
#include "lights/light_surfaces.h"
#include "textures/resolve.h"

namespace etd {

inline const ModelDecl& diffuse_area_decl() {
  static const ModelDecl d{Family::kAreaLight,
                           "diffuse",
                           "Emits the same radiance to all directions from every point of a shape.",
                           {{.name = "L",
                             .type = ParamType::kSpectrum,
                             .default_value = 1.0,
                             .min = 0,
                             .unit = "W/(m^2 sr)",
                             .doc = "Emitted radiance."},
                            {.name = "scale", .default_value = 1.0, .min = 0, .doc = "Factor on the radiance."},
                            {.name = "twosided",
                             .type = ParamType::kBool,
                             .default_value = false,
                             .doc = "Emit from both sides, not just from that of the surface normal."}}};
  return d;
}

template <class Surface>
struct DiffuseAreaLight {
  Spectrum radiance;
  Surface surface;
  bool two_sided = false;

  bool is_infinite() const { return false; }
  bool is_delta() const { return false; }

  Spectrum emitted(const SurfacePoint* s, Vec3 w) const {
    return two_sided || dot(s->ng, w) > 0.0f ? radiance : Spectrum();
  }

  std::optional<LightSample> sample_li(Point3 p, Vec2 u, LightSampling) const {
    LightSample s;
    float pdf_area = 0;
    s.on_light = surface.sample(u, pdf_area);
    const Vec3 d = s.on_light.p - p;
    const float d2 = dot(d, d);
    if (!(d2 > 0.0f)) return {};
    s.wi = d * (1.0f / std::sqrt(d2));
    s.radiance = emitted(&s.on_light, -s.wi);
    s.pdf = to_solid_angle(pdf_area, d2, dot(s.on_light.ng, s.wi));
    if (is_black(s.radiance) || !(s.pdf > 0.0f) || !std::isfinite(s.pdf)) return {};
    return s;
  }

  float pdf_li(Point3 p, Vec3 wi, const SurfacePoint* s, LightSampling) const {
    const Vec3 d = s->p - p;
    const float pdf = to_solid_angle(surface.pdf_area(s->p), dot(d, d), dot(s->ng, wi));
    return std::isfinite(pdf) ? pdf : 0.0f;
  }

  Spectrum power() const { return radiance * (kPi * surface.area() * (two_sided ? 2.0f : 1.0f)); }

 private:
  // Density per area to density per solid angle: times d^2 / |cos|.
  static float to_solid_angle(float pdf_area, float distance2, float cosine) {
    return pdf_area * distance2 / std::abs(cosine);
  }
};

}  // namespace etd
