// Mean absolute error, in the unit of the values: less moved by few large errors than the squared one.
#pragma once

#include <cmath>
#include <span>

namespace etd {

inline double mae(std::span<const float> x, std::span<const float> r) {
  double sum = 0;
  for (size_t i = 0; i < x.size(); ++i) sum += std::abs(static_cast<double>(x[i]) - r[i]);
  return x.empty() ? 0.0 : sum / static_cast<double>(x.size());
}

}  // namespace etd
