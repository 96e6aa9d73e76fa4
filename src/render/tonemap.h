// Maps linear light of any range to what a screen can show.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "core/vec.h"

namespace etd {

enum class ToneOperator {
  kSrgb,   // clipped at 1
  kFilmic  // shoulders and toes of film: Narkowicz 2015, "ACES Filmic Tone Mapping Curve", on each channel
};

struct ToneMapping {
  double exposure = 0;                            // in stops
  std::optional<std::array<Vec3d, 3>> balance{};  // adapt_rec709(), applied first
  ToneOperator curve = ToneOperator::kSrgb;
};

// The light on the screen, in [0, 1] and linear (files store it through the sRGB curve), of linear Rec.709 values,
// three a pixel, in place. Returns in how many pixels a value is not a number; they become black.
size_t tone_map(std::span<float> rgb, const ToneMapping& mapping);

// The matrix that makes the mean over all finite pixels grey (grey-world assumption; Buchsbaum 1980). Nothing when that
// mean is black or has negative channels.
std::optional<std::array<Vec3d, 3>> grey_world_balance(std::span<const float> rgb);

}  // namespace etd
