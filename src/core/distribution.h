// Choosing one of n things, or a point of a grid, in proportion to weights.
#pragma once

#include <span>
#include <vector>

#include "core/vec.h"

namespace etd {

// One of n in constant time: Walker's alias method as built by Vose (1991).
class AliasTable {
 public:
  AliasTable() = default;
  // Weights are finite and not negative. If all are zero, every index has probability 0.
  explicit AliasTable(std::span<const double> weights);

  size_t size() const { return bins_.size(); }
  // The index for u in [0, 1); only for tables with a positive weight. A double, because u is spread over all indices:
  // the 24 bits of a float would leave a few values to each of a million, and none to the faint ones.
  uint32_t sample(double u) const {
    const double scaled = u * static_cast<double>(bins_.size());
    const auto bin = std::min(static_cast<size_t>(scaled), bins_.size() - 1);
    return scaled - static_cast<double>(bin) < bins_[bin].threshold ? static_cast<uint32_t>(bin) : bins_[bin].alias;
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

// A point of the unit square whose density is constant in each cell of a grid, by inversion of the distribution of
// rows and of that within the row, which keeps strata together where alias tables would scatter them.
class GridDistribution {
 public:
  // A cell and where in it, in [0, 1)^2.
  struct Sample {
    int x = 0, y = 0;
    Vec2 offset;
  };

  GridDistribution() = default;
  // width * height weights, row by row, finite and not negative. If all are zero, every cell has probability 0.
  GridDistribution(int width, int height, std::span<const double> weights);

  int width() const { return width_; }
  int height() const { return static_cast<int>(rows_.size()); }
  // Whether any cell can be chosen.
  bool any() const { return !rows_.empty(); }
  // The cell for u in [0, 1)^2; only if any() is true.
  Sample sample(Vec2 u) const;
  // The probability of a cell: its weight's share, not the difference of rounded sums.
  float probability(int x, int y) const {
    return any() ? probabilities_[static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x)] : 0.0f;
  }
  size_t bytes() const { return (rows_.size() + columns_.size() + probabilities_.size()) * sizeof(float); }

 private:
  int width_ = 0;
  std::vector<float> rows_;     // the sums of rows up to and including each
  std::vector<float> columns_;  // for each row, the same of its cells
  std::vector<float> probabilities_;
};

}  // namespace etd
