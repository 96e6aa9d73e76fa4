// Relative mean squared error, the usual measure of Monte Carlo noise: dark and bright parts count alike. A few
// fireflies can make up nearly all of it, so it is always given twice, with and without the worst pixels: a large gap
// between the two says that they do.
#pragma once

#include <span>

namespace etd {

struct RelMse {
  double plain = 0;
  double trimmed = 0;  // without the largest 0.1 % of the pixels (rounded down)
};

// The mean over the pixels of (x - r)^2 / (r^2 + 0.01), itself a mean over the `channels` interleaved values of a
// pixel.
RelMse rel_mse(std::span<const float> x, std::span<const float> r, int channels = 1);

}  // namespace etd
