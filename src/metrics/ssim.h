// Structural similarity of what a screen shows (Wang, Bovik, Sheikh and Simoncelli 2004).
#pragma once

#include <optional>

#include "metrics/plane.h"

namespace etd {

// The mean of eq. 13 with the paper's constants (K1 = 0.01, K2 = 0.03, values in [0, 1], a Gaussian window of 11 x 11
// pixels and standard deviation 1.5) over all places where the window lies inside the picture: 1 for equal pictures.
// Nothing for pictures smaller than the window.
std::optional<double> ssim(const Plane& x, const Plane& r);

}  // namespace etd
