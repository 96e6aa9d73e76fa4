// From linear light of any range to what a screen can show.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/vec.h"
#include "io/image_write.h"

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

// Three values a pixel, or why there are none.
struct LayerResult {
  std::vector<float> rgb;
  std::string error;
};
// A layer as a picture: "" for the image itself, otherwise the channels whose names begin with "LAYER.": R, G, B or
// X, Y, Z, or a single one as grey.
LayerResult layer_rgb(const LayeredImage& image, std::string_view layer);

// The matrix that makes the mean over all finite pixels grey (grey-world assumption; Buchsbaum 1980). Nothing when that
// mean is black or has negative channels.
std::optional<std::array<Vec3d, 3>> grey_world_balance(std::span<const float> rgb);

}  // namespace etd
