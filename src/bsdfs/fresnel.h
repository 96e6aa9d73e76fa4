// Reflectance of a plane boundary between two media for unpolarised light: what makes glass and metals look as they do.
// Both functions are exact, finite for every cosine in [0, 1], and 1 at grazing incidence (unless the media are equal).
#pragma once

#include "core/math.h"
#include "spectrum/spectrum.h"

namespace etd {

struct DielectricBoundary {
  float reflectance = 1;  // share of the flux that is reflected
  float cos_t = 0;        // cosine of the refracted direction to the normal; 0 under total internal reflection
};

// The incidence cosine cos_i is in [0, 1], and `eta` > 0 is the index on the far side over that on the near side (Born
// and Wolf 1999, section 1.5.2, equations 21). The refracted cosine is written with (eta - 1)(eta + 1) + cos_i^2, which
// does not cancel at grazing incidence.
ETD_FN DielectricBoundary fresnel_dielectric(float cos_i, float eta) {
  if (eta == 1.0f) return {0.0f, cos_i};
  const float scaled_cos2 = (eta - 1.0f) * (eta + 1.0f) + cos_i * cos_i;
  if (!(scaled_cos2 > 0.0f)) return {};
  const float cos_t = std::min(std::sqrt(scaled_cos2) / eta, 1.0f);
  const float r_parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const float r_perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return {0.5f * (r_parallel * r_parallel + r_perpendicular * r_perpendicular), cos_t};
}

// One wavelength on an absorbing medium of relative index eta + i k (Born and Wolf 1999, section 14.2). With
// a + i b = sqrt((eta + i k)^2 - sin^2), the two polarisations are sums of squares, so nothing cancels; of a and b the
// smaller comes from a b = eta k. A vanishing denominator belongs to the limits eta = k = 0 and grazing: 1.
ETD_FN float fresnel_conductor(float cos_i, float eta, float k) {
  const float cos2 = cos_i * cos_i, sin2 = std::max(0.0f, 1.0f - cos2);
  const float re = (eta - 1.0f) * (eta + 1.0f) - k * k + cos2, im = 2.0f * eta * k;
  const float modulus = std::sqrt(re * re + im * im);
  float a = std::sqrt(0.5f * (modulus + std::abs(re)));
  float b = a > 0.0f ? eta * k / a : 0.0f;
  if (re < 0.0f) std::swap(a, b);

  const auto ratio = [](float numerator, float denominator) {
    return denominator > 0.0f ? numerator / denominator : 1.0f;
  };
  const float r_perpendicular = ratio(sqr(a - cos_i) + b * b, sqr(a + cos_i) + b * b);
  const float r_parallel = r_perpendicular * ratio(sqr(a * cos_i - sin2) + b * b * cos2,  //
                                                   sqr(a * cos_i + sin2) + b * b * cos2);
  return 0.5f * (r_parallel + r_perpendicular);
}

ETD_FN Spectrum fresnel_conductor(float cos_i, const Spectrum& eta, const Spectrum& k) {
  Spectrum r;
  for (int i = 0; i < Spectrum::kLanes; ++i) r.v[i] = fresnel_conductor(cos_i, eta[i], k[i]);
  return r;
}

}  // namespace etd
