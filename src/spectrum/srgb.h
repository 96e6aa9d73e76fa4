// The sRGB transfer curve both ways, piecewise as IEC 61966-2-1:1999 defines it: how 8-bit images store linear Rec.709.
#pragma once

#include "core/math.h"

namespace etd {

// Linear value of an encoded one in [0, 1].
ETD_FN float srgb_to_linear(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

// Encoded value of a linear one in [0, 1].
ETD_FN float linear_to_srgb(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

// The byte that shows a linear value: clamped to [0, 1], rounded to nearest; NaN becomes 0.
ETD_FN uint8_t linear_to_srgb8(float linear) {
  if (!(linear > 0.0f)) return 0;
  return static_cast<uint8_t>(255.0f * linear_to_srgb(linear < 1.0f ? linear : 1.0f) + 0.5f);
}

}  // namespace etd
