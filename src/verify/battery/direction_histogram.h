// Sampled directions against the density that is said of them: the histogram that lights and phase functions share.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "core/hash.h"
#include "core/vec.h"
#include "verify/battery/worst.h"

namespace etd {

struct DirectionDensity {
  std::function<std::optional<Vec3>(HashStream&)> draw;  // nothing on failure
  std::function<double(Vec3)> pdf;                       // per solid angle
  bool jumps = false;                                    // the density has edges
  size_t cells = 64;                                     // about as many
  double integration_error = 1e-3;  // that the integral over the sphere may have with 40,000 samples; less with more
};

// Chi-square of `samples` directions with a cell for failures, and the integral of the density against the share of
// samples that did not fail.
void check_direction_density(const DirectionDensity& density, const std::string& where, size_t samples, uint64_t seed,
                             WorstP& chi_square, WorstP& mass);

}  // namespace etd
