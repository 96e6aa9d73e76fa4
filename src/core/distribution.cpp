#include "core/distribution.h"

#include <algorithm>

namespace etd {

AliasTable::AliasTable(std::span<const double> weights) : bins_(weights.size()) {
  double sum = 0.0;
  for (double w : weights) sum += w;
  if (!(sum > 0.0)) return;
  struct Entry {
    uint32_t index;
    double scaled;  // probability times n
  };
  std::vector<Entry> under, over;
  for (uint32_t i = 0; i < bins_.size(); ++i) {
    const double p = weights[i] / sum;
    bins_[i] = {1.0f, static_cast<float>(p), i};
    const double scaled = p * static_cast<double>(bins_.size());
    (scaled < 1.0 ? under : over).push_back({i, scaled});
  }
  while (!under.empty() && !over.empty()) {
    const Entry small = under.back();
    under.pop_back();
    Entry& large = over.back();
    bins_[small.index].threshold = static_cast<float>(small.scaled);
    bins_[small.index].alias = large.index;
    large.scaled -= 1.0 - small.scaled;
    if (large.scaled < 1.0) {
      under.push_back(large);
      over.pop_back();
    }
  }
  // What is left differs from 1 by rounding alone, but must not be reached with weight zero.
  for (const Entry& e : under)
    if (weights[e.index] == 0.0) {
      uint32_t heaviest = 0;
      for (uint32_t i = 1; i < bins_.size(); ++i)
        if (weights[i] > weights[heaviest]) heaviest = i;
      bins_[e.index].threshold = 0.0f;
      bins_[e.index].alias = heaviest;
    }
}

namespace {

// Writes the running sums of the weights over their total, which is returned. The last is exactly 1, and so are those
// of trailing zeros; all are 0 if the total is.
template <class T>
double write_running_sums(std::span<const T> weights, float* out) {
  double total = 0.0, sum = 0.0;
  for (const T w : weights) total += w;
  for (const T w : weights) {
    sum += w;
    *out++ = total > 0.0 ? static_cast<float>(sum / total) : 0.0f;
  }
  return total;
}

// The first index whose running sum exceeds u, and where between it and the one before u lies.
int invert(std::span<const float> sums, float u, float& offset) {
  const auto it = std::upper_bound(sums.begin(), sums.end() - 1, u);
  const float before = it == sums.begin() ? 0.0f : *(it - 1);
  offset = clamp((u - before) / (*it - before), 0.0f, kOneMinusEpsilon);
  return static_cast<int>(it - sums.begin());
}

}  // namespace

GridDistribution::GridDistribution(int width, int height, std::span<const double> weights) : width_(width) {
  const auto w = static_cast<size_t>(width), h = static_cast<size_t>(height);
  columns_.resize(w * h);
  std::vector<double> row_totals;
  for (size_t y = 0; y < h; ++y)
    row_totals.push_back(write_running_sums(weights.subspan(y * w, w), columns_.data() + y * w));
  rows_.resize(h);
  const double total = write_running_sums(std::span<const double>(row_totals), rows_.data());
  if (!(total > 0.0)) {
    *this = GridDistribution();
    return;
  }
  probabilities_.reserve(w * h);
  for (const double weight : weights) probabilities_.push_back(static_cast<float>(weight / total));
}

GridDistribution::Sample GridDistribution::sample(Vec2 u) const {
  Sample s;
  s.y = invert(rows_, u.y, s.offset.y);
  const auto w = static_cast<size_t>(width_);
  s.x = invert(std::span(columns_).subspan(static_cast<size_t>(s.y) * w, w), u.x, s.offset.x);
  return s;
}

}  // namespace etd
