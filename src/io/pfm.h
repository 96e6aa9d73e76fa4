// Portable float maps: three floats a pixel (or one), nothing else. Our own, because readers elsewhere let truncated
// files pass. Format: Paul Debevec, "PFM Portable FloatMap Image Format".
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "io/image.h"

namespace etd {

// The image in the bytes of a PFM file: colour or grey, both byte orders, values times the header's scale.
ImageResult decode_pfm(std::string_view bytes);

// The bytes of a little-endian colour file of scale 1: its header, then its rows from the lowest to the highest, each
// of three floats a pixel.
std::string pfm_header(int width, int height);
std::string pfm_row(std::span<const float> rgb);
// The whole of it; `rgb` has its rows from the top.
std::string encode_pfm(int width, int height, std::span<const float> rgb);

}  // namespace etd
