// Root of the mean squared error, in the unit of the values.
#pragma once

#include <cmath>

#include "metrics/mse.h"

namespace etd {

inline double rmse(std::span<const float> x, std::span<const float> r) { return std::sqrt(mse(x, r)); }

}  // namespace etd
