// Radiance, reflectance and throughput: four float lanes. In RGB mode the first three are linear Rec.709 and the fourth
// is padding: filled where values enter, multiplied along, read by nothing. Transport code multiplies lanes and never
// asks what they mean; what must know the active lanes goes through the functions below.
#pragma once

#include "core/math.h"

namespace etd {

struct alignas(16) Spectrum {
  static constexpr int kLanes = 4;
  static constexpr int kActive = 3;
  float v[kLanes] = {0, 0, 0, 0};

  constexpr Spectrum() = default;
  explicit constexpr Spectrum(float c) : v{c, c, c, c} {}
  // Linear Rec.709; the padding lane repeats green so that it stays of the size of the others.
  static constexpr Spectrum rgb(float r, float g, float b) {
    Spectrum s;
    s.v[0] = r, s.v[1] = g, s.v[2] = b, s.v[3] = g;
    return s;
  }

  float operator[](int i) const { return v[i]; }

  Spectrum& operator+=(const Spectrum& b) {
    for (int i = 0; i < kLanes; ++i) v[i] += b.v[i];
    return *this;
  }
  Spectrum& operator*=(const Spectrum& b) {
    for (int i = 0; i < kLanes; ++i) v[i] *= b.v[i];
    return *this;
  }
  Spectrum& operator*=(float s) {
    for (int i = 0; i < kLanes; ++i) v[i] *= s;
    return *this;
  }
  friend Spectrum operator+(Spectrum a, const Spectrum& b) { return a += b; }
  friend Spectrum operator*(Spectrum a, const Spectrum& b) { return a *= b; }
  friend Spectrum operator*(Spectrum a, float s) { return a *= s; }
  friend Spectrum operator*(float s, Spectrum a) { return a *= s; }
  friend Spectrum operator-(Spectrum a, const Spectrum& b) {
    for (int i = 0; i < kLanes; ++i) a.v[i] -= b.v[i];
    return a;
  }
  friend Spectrum operator/(Spectrum a, float s) { return a *= 1.0f / s; }
};

ETD_FN float max_value(const Spectrum& s) { return std::max(s.v[0], std::max(s.v[1], s.v[2])); }
ETD_FN float min_value(const Spectrum& s) { return std::min(s.v[0], std::min(s.v[1], s.v[2])); }
ETD_FN float mean_value(const Spectrum& s) { return (s.v[0] + s.v[1] + s.v[2]) * (1.0f / 3.0f); }
// Lane by lane; NaN gives lo.
ETD_FN Spectrum max(Spectrum s, float lo) {
  for (float& v : s.v) v = v > lo ? v : lo;
  return s;
}
ETD_FN Spectrum clamp(Spectrum s, float lo, float hi) {
  for (float& v : s.v) v = clamp(v, lo, hi);
  return s;
}
ETD_FN bool is_black(const Spectrum& s) { return s.v[0] == 0.0f && s.v[1] == 0.0f && s.v[2] == 0.0f; }
ETD_FN bool is_finite(const Spectrum& s) {
  return std::isfinite(s.v[0]) && std::isfinite(s.v[1]) && std::isfinite(s.v[2]);
}
// Luminance of linear Rec.709 (ITU-R BT.709-6, 3.3).
ETD_FN float luminance(float r, float g, float b) { return 0.2126f * r + 0.7152f * g + 0.0722f * b; }
ETD_FN double luminance(double r, double g, double b) { return 0.2126 * r + 0.7152 * g + 0.0722 * b; }
ETD_FN float luminance(const Spectrum& s) { return luminance(s.v[0], s.v[1], s.v[2]); }

}  // namespace etd
