// Three values a pixel, whatever file and layer they came from: what is compared, mapped to a screen, and shown.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/bounds.h"
#include "io/image_write.h"
#include "io/layer_choice.h"

namespace etd {

struct Picture {
  int width = 0, height = 0;
  std::vector<float> rgb;  // rows from the top

  size_t pixels() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }
};

// The channels of an EXR's part or layer of that name, with an empty name of the one that is the picture
// (io/layer_choice.h); beside the picture those of all other parts that cover the same pixels. An error that lists
// parts and layers where there is not one to choose. Of another image file (read_image() lists the formats) linear R, G
// and B.
LayersResult read_any_layers(const std::filesystem::path& path, const std::string& layer = {});
// Which part or layer read_any_layers() takes when none is named, and the error where there is not one to choose.
LayerChoice choose_picture(const std::vector<ImagePart>& parts, std::vector<PartLayer>& layers,
                           const std::string& layer = {});

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
