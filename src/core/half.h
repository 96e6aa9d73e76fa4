// Numbers of 16 bits (IEEE 754 binary16): eleven significant bits, from 6e-8 to 65504.
#pragma once

#include "core/math.h"

namespace etd {

// Exact. Denormal halves become normal floats, whatever the processor does with denormal ones.
ETD_FN float half_to_float(uint16_t h) {
  const uint32_t sign = static_cast<uint32_t>(h & 0x8000u) << 16, magnitude = h & 0x7fffu;
  if (magnitude < 0x0400u) {
    const float small = static_cast<float>(magnitude) * 0x1p-24f;
    return sign ? -small : small;
  }
  const uint32_t rebias = magnitude < 0x7c00u ? 112u << 23 : 224u << 23;  // the latter for infinities and NaN
  return float_from_bits(sign | ((magnitude << 13) + rebias));
}

// The nearest half, ties to even. Finite numbers beyond the largest half become the largest.
ETD_FN uint16_t float_to_half(float f) {
  const uint32_t bits = float_bits(f), sign = bits >> 16 & 0x8000u, magnitude = bits & 0x7fffffffu;
  uint32_t h = 0;
  if (magnitude > 0x7f800000u)
    h = 0x7e00u;  // NaN
  else if (magnitude == 0x7f800000u)
    h = 0x7c00u;
  else if (magnitude >= 0x477ff000u)
    h = 0x7bffu;
  else if (magnitude < 0x38800000u)
    h = static_cast<uint32_t>(std::nearbyint(float_from_bits(magnitude) * 0x1p24f));
  else
    h = (magnitude - (112u << 23) + 0xfffu + (magnitude >> 13 & 1u)) >> 13;
  return static_cast<uint16_t>(sign | h);
}

}  // namespace etd
