// Three values a pixel, whatever file and layer they came from: what is compared, mapped to a screen, and shown.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/bounds.h"
#include "io/image_write.h"

namespace etd {

struct Picture {
  int width = 0, height = 0;
  std::vector<float> rgb;  // rows from the top

  size_t pixels() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }
};

// Every channel of an EXR, or those of another image file (read_image() lists the formats) as linear R, G and B.
LayersResult read_any_layers(const std::filesystem::path& path);

// Three values a pixel, or why there are none.
struct LayerResult {
  std::vector<float> rgb;
  std::string error;
};
// A layer as a picture: "" for the image itself, otherwise the channels whose names begin with "LAYER.": R, G, B or
// X, Y, Z, or a single one as grey.
LayerResult layer_rgb(const LayeredImage& image, std::string_view layer);

// The pixels inside bounds (in pixels of the picture), which must lie within it.
Picture crop(const Picture& picture, const PixelBounds& bounds);

}  // namespace etd
