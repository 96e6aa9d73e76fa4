// Mean squared error, of values or of the channels of pixels alike: mean of (x - r)^2.
#pragma once

#include <span>

namespace etd {

// Returns the mean squared error of values x against a reference r of as many, in the square of their unit; 0 for none.
inline double mse(std::span<const float> x, std::span<const float> r) {
  double sum = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    const double d = static_cast<double>(x[i]) - r[i];
    sum += d * d;
  }
  return x.empty() ? 0.0 : sum / static_cast<double>(x.size());
}

}  // namespace etd
