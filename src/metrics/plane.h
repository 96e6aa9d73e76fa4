// One number for each pixel, and separable filters over them: what the metrics that look at neighbourhoods work on.
#pragma once

#include <vector>

#include "io/picture.h"

namespace etd {

struct Plane {
  int width = 0, height = 0;
  std::vector<float> values;  // rows from the top

  Plane() = default;
  Plane(int w, int h) : width(w), height(h), values(static_cast<size_t>(w) * static_cast<size_t>(h)) {}
  float& at(int x, int y) {
    return values[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  }
  float at(int x, int y) const {
    return values[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  }
};

// Channel 0, 1, 2 of a picture, or its luminance.
Plane channel_plane(const Picture& picture, int channel);
Plane luminance_plane(const Picture& picture);

// Weights of 2 radius + 1 pixels in a row.
using Kernel = std::vector<float>;
// exp(-x^2 / (2 sigma^2)) at whole pixels up to `radius`, of sum 1.
Kernel gaussian_kernel(double sigma, int radius);

// The sum of across[i] down[j] times the pixel at (x + i, y + j); beyond the border its nearest pixel counts.
Plane convolve(const Plane& plane, const Kernel& across, const Kernel& down);

}  // namespace etd
