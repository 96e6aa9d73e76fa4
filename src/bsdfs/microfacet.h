// The GGX (Trowbridge and Reitz 1975; Walter et al. 2007) distribution of microfacet normals on a rough surface, with
// anisotropic widths. Everything is written with components of directions, never with 1 - cos^2, so that it keeps its
// precision in float for alpha from 1e-4 up and at grazing incidence. All directions are unit and have z >= 0.
#pragma once

#include "core/vec.h"

namespace etd {

struct Ggx {
  float ax = 1, ay = 1;  // root mean square slopes up to a common factor; >= 1e-4

  // Density of normals h: projected area per solid angle (Heitz 2014, equation 85), so that D(h) h.z integrates to 1.
  float d(Vec3 h) const {
    const float x = h.x / ax, y = h.y / ay, t = x * x + y * y + h.z * h.z;
    return kInvPi / (ax * ay * t * t);
  }

  // |(ax w.x, ay w.y, w.z)|. Smith's Lambda is (stretched(w) / w.z - 1) / 2 (Heitz 2014, equation 86), which makes all
  // the functions below free of divisions by a cosine.
  float stretched(Vec3 w) const { return std::sqrt(sqr(ax * w.x) + sqr(ay * w.y) + w.z * w.z); }

  // Share of the facets facing w that w sees: 1 / (1 + Lambda(w)) (Heitz 2014, equation 43). 0 at the horizon.
  float g1(Vec3 w) const { return 2.0f * w.z / (w.z + stretched(w)); }

  // Share seen from both, with heights correlated: 1 / (1 + Lambda(wo) + Lambda(wi)) (Heitz 2014, equation 99), divided
  // by 4 wo.z wi.z as the reflection operator wants it, times wi.z. wi.z > 0.
  float reflection_factor(Vec3 wo, Vec3 wi) const { return 0.5f / (stretched(wo) + stretched(wi) * (wo.z / wi.z)); }

  // Density, per solid angle of wi, of reflecting wo about a visible normal h: g1 D / (4 wo.z) (Heitz 2018).
  float pdf_reflection(Vec3 wo, Vec3 h) const { return d(h) * reflection_pdf_factor(wo); }
  float reflection_pdf_factor(Vec3 wo) const { return 0.5f / (wo.z + stretched(wo)); }

  // A normal from the density g1(wo) max(0, wo.h) D(h) / wo.z: reflect off the unit hemisphere of the stretched
  // configuration, whose reflected directions fill a spherical cap uniformly (Dupuy and Benyoub 2023, listing 3). 1 - z
  // is kept as a product, so that the cap's centre is not rounded away.
  Vec3 sample_visible(Vec3 wo, Vec2 u) const {
    const Vec3 w = normalize(Vec3{ax * wo.x, ay * wo.y, wo.z});
    const float one_minus_z = u.y * (1.0f + w.z), z = 1.0f - one_minus_z;
    const float sin_theta = safe_sqrt(one_minus_z * (1.0f + z)), phi = 2.0f * kPi * u.x;
    const Vec3 h = w + Vec3{sin_theta * std::cos(phi), sin_theta * std::sin(phi), z};
    return normalize(Vec3{ax * h.x, ay * h.y, std::max(h.z, 1e-7f)});
  }
};

}  // namespace etd
