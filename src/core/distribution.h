// Choosing one of n things in proportion to weights, in constant time.
#pragma once

#include <span>
#include <vector>

#include "core/math.h"

namespace etd {

// Walker's alias method as built by Vose (1991).
class AliasTable {
 public:
  AliasTable() = default;
  // Weights are finite and not negative. If all are zero, every index has probability 0.
  explicit AliasTable(std::span<const double> weights);

  size_t size() const { return bins_.size(); }
  // The index for u in [0, 1); only for tables with a positive weight.
  uint32_t sample(float u) const {
    const double scaled = static_cast<double>(u) * static_cast<double>(bins_.size());
    const auto bin = std::min(static_cast<size_t>(scaled), bins_.size() - 1);
    return static_cast<float>(scaled - static_cast<double>(bin)) < bins_[bin].threshold ? static_cast<uint32_t>(bin)
                                                                                        : bins_[bin].alias;
  }
  // The probability with which sample() gives the index.
  float probability(uint32_t index) const { return bins_[index].probability; }

 private:
  struct Bin {
    float threshold = 1, probability = 0;
    uint32_t alias = 0;
  };
  std::vector<Bin> bins_;
};

}  // namespace etd
