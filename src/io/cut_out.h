// What a picture shows without what is behind everything, and the alpha that says how much of a pixel it covers.
#pragma once

#include <string>
#include <vector>

#include "io/image_write.h"

namespace etd {

struct CutOut {
  std::vector<float> rgb, alpha;  // three values and one a pixel
  std::string error;              // why there is none
  std::string note;               // what has been guessed
};

// Takes an image with the layer "foreground", or with a channel A, by which its colours are multiplied already as the
// format prescribes. For a render that kept neither, coverage is taken for alpha; then emission that is seen directly
// in pixels that are not covered, if there is any, is what is behind everything, also where a pixel is covered in part.
CutOut cut_out(const LayeredImage& image);
// Of one layer (layer_rgb()), which has R, G, B and A of its own.
CutOut cut_out_layer(const LayeredImage& image, const std::string& layer);

// Makes of colours multiplied by alpha those of what covers the pixel; black where nothing does.
void divide_by_alpha(CutOut& picture);

}  // namespace etd
