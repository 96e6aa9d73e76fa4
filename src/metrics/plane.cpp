#include "metrics/plane.h"

#include <algorithm>
#include <cmath>

#include "spectrum/spectrum.h"

namespace etd {
namespace {

// Filters along the rows and turns the picture, so that doing it twice filters both ways and turns it back.
Plane convolve_rows_and_transpose(const Plane& plane, const Kernel& kernel) {
  const int radius = static_cast<int>(kernel.size() / 2), w = plane.width;
  Plane result(plane.height, w);
  std::vector<float> row(static_cast<size_t>(w + 2 * radius));
  for (int y = 0; y < plane.height; ++y) {
    for (int x = -radius; x < w + radius; ++x)
      row[static_cast<size_t>(x + radius)] = plane.at(std::clamp(x, 0, w - 1), y);
    for (int x = 0; x < w; ++x) {
      float sum = 0;
      for (size_t k = 0; k < kernel.size(); ++k) sum += kernel[k] * row[static_cast<size_t>(x) + k];
      result.at(y, x) = sum;
    }
  }
  return result;
}

}  // namespace

Plane channel_plane(const Picture& picture, int channel) {
  Plane plane(picture.width, picture.height);
  for (size_t i = 0; i < plane.values.size(); ++i) plane.values[i] = picture.rgb[3 * i + static_cast<size_t>(channel)];
  return plane;
}

Plane luminance_plane(const Picture& picture) {
  Plane plane(picture.width, picture.height);
  for (size_t i = 0; i < plane.values.size(); ++i) {
    const float* p = &picture.rgb[3 * i];
    plane.values[i] = luminance(p[0], p[1], p[2]);
  }
  return plane;
}

Kernel gaussian_kernel(double sigma, int radius) {
  Kernel kernel;
  double sum = 0;
  for (int x = -radius; x <= radius; ++x) sum += std::exp(-x * x / (2 * sigma * sigma));
  for (int x = -radius; x <= radius; ++x)
    kernel.push_back(static_cast<float>(std::exp(-x * x / (2 * sigma * sigma)) / sum));
  return kernel;
}

Plane convolve(const Plane& plane, const Kernel& across, const Kernel& down) {
  return convolve_rows_and_transpose(convolve_rows_and_transpose(plane, across), down);
}

}  // namespace etd
