// Scalar helpers and constants that the whole renderer shares.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "core/fn.h"

namespace etd {

inline constexpr float kPi = 3.14159265358979323846f;
inline constexpr double kPiD = 3.14159265358979323846;
inline constexpr float kInvPi = 1.0f / kPi;
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
// Largest float below one: keeps uniform numbers in [0, 1).
inline constexpr float kOneMinusEpsilon = 0x1.fffffep-1f;

ETD_FN float sqr(float x) { return x * x; }
ETD_FN double sqr(double x) { return x * x; }
ETD_FN float safe_sqrt(float x) { return std::sqrt(x > 0.0f ? x : 0.0f); }
ETD_FN float lerp(float t, float a, float b) { return (1.0f - t) * a + t * b; }
// NaN gives lo.
ETD_FN float clamp(float x, float lo, float hi) { return x > lo ? (x < hi ? x : hi) : lo; }
ETD_FN double radians(double degrees) { return degrees * (kPiD / 180.0); }

ETD_FN uint32_t float_bits(float f) {
  uint32_t u;
  std::memcpy(&u, &f, sizeof u);
  return u;
}

ETD_FN float float_from_bits(uint32_t u) {
  float f;
  std::memcpy(&f, &u, sizeof f);
  return f;
}

// The neighbouring float above or below x; infinities and NaN stay as they are.
ETD_FN float next_up(float x) {
  if (!(x < kInfinity)) return x;
  if (x == 0.0f) return float_from_bits(1);
  return float_from_bits(x > 0.0f ? float_bits(x) + 1 : float_bits(x) - 1);
}
ETD_FN float next_down(float x) { return -next_up(-x); }

// Maps 32 random bits to a float in [0, 1).
ETD_FN float unit_float(uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

}  // namespace etd
