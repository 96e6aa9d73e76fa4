// Peak signal-to-noise ratio of values on a screen, whose peak is 1: 10 log10(1 / MSE) decibels.
#pragma once

#include <cmath>
#include <limits>

#include "metrics/mse.h"

namespace etd {

// +inf for equal pictures.
inline double psnr(std::span<const float> x, std::span<const float> r) {
  const double error = mse(x, r);
  return error > 0 ? -10 * std::log10(error) : std::numeric_limits<double>::infinity();
}

}  // namespace etd
