// Multiple importance sampling of two techniques with one sample of each (Veach 1997, section 9.2): how much each
// counts where both could have made the sample. All of these give the same mean; they differ in variance.
#pragma once

#include <cmath>
#include <cstdint>
#include <string_view>

#include "core/fn.h"

namespace etd {

enum class MisHeuristic : uint8_t {
  kPower,    // with exponent 2: eq. 9.13
  kBalance,  // eq. 9.8
  kMaximum,  // all to the larger density: eq. 9.14
  kUniform,  // half to each
};

// Returns the heuristic of a declared name: power, balance, maximum or uniform.
inline MisHeuristic mis_heuristic(std::string_view name) {
  return name == "balance"   ? MisHeuristic::kBalance
         : name == "maximum" ? MisHeuristic::kMaximum
         : name == "uniform" ? MisHeuristic::kUniform
                             : MisHeuristic::kPower;
}

// The weight of a sample made with density `pdf` that the other technique makes with density `other`. The weights of
// the two sum to 1 wherever one of them is positive. Infinite densities come from squares that no float holds.
ETD_FN float mis_weight(MisHeuristic heuristic, float pdf, float other) {
  const float larger = pdf > other ? 1.0f : (pdf == other && pdf > 0.0f ? 0.5f : 0.0f);
  if (std::isinf(pdf) || std::isinf(other)) return larger;
  switch (heuristic) {
    case MisHeuristic::kBalance: {
      const float sum = pdf + other;
      return sum > 0.0f && std::isfinite(sum) ? pdf / sum : larger;
    }
    case MisHeuristic::kMaximum:
      return larger;
    case MisHeuristic::kUniform:
      return pdf > 0.0f ? (other > 0.0f ? 0.5f : 1.0f) : 0.0f;
    case MisHeuristic::kPower:
      break;
  }
  const float p2 = pdf * pdf, o2 = other * other;
  return p2 + o2 > 0.0f && std::isfinite(p2 + o2) ? p2 / (p2 + o2) : larger;
}

}  // namespace etd
