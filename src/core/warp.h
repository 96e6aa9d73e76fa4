// Maps from the unit square to the domains that sampling needs. Each has its density beside it; densities over
// directions are per solid angle.
#pragma once

#include "core/vec.h"

namespace etd {

// Uniform on the unit disk; concentric, so strata stay compact (Shirley and Chiu 1997).
ETD_FN Vec2 sample_disk_concentric(Vec2 u) {
  const float a = 2.0f * u.x - 1.0f, b = 2.0f * u.y - 1.0f;
  if (a == 0.0f && b == 0.0f) return {};
  float r, phi;
  if (std::abs(a) > std::abs(b)) {
    r = a;
    phi = (kPi / 4.0f) * (b / a);
  } else {
    r = b;
    phi = kPi / 2.0f - (kPi / 4.0f) * (a / b);
  }
  return {r * std::cos(phi), r * std::sin(phi)};
}
ETD_FN float pdf_disk() { return kInvPi; }

// Density cos(theta) / pi on the hemisphere z > 0 (Malley's method).
ETD_FN Vec3 sample_hemisphere_cosine(Vec2 u) {
  const Vec2 d = sample_disk_concentric(u);
  return {d.x, d.y, safe_sqrt(1.0f - d.x * d.x - d.y * d.y)};
}
ETD_FN float pdf_hemisphere_cosine(float cos_theta) { return cos_theta > 0.0f ? cos_theta * kInvPi : 0.0f; }

ETD_FN Vec3 sample_sphere_uniform(Vec2 u) {
  const float z = 1.0f - 2.0f * u.x, r = safe_sqrt(1.0f - z * z), phi = 2.0f * kPi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), z};
}
ETD_FN float pdf_sphere_uniform() { return 1.0f / (4.0f * kPi); }

// Barycentric coordinates (b0, b1; b2 = 1 - b0 - b1) of a uniform point on a triangle: folds the square along its
// diagonal with little distortion (Heitz 2019, "A low-distortion map between triangle and square").
ETD_FN Vec2 sample_triangle_uniform(Vec2 u) {
  if (u.x < u.y) {
    const float b0 = u.x / 2.0f;
    return {b0, u.y - b0};
  }
  const float b1 = u.y / 2.0f;
  return {u.x - b1, b1};
}

}  // namespace etd
