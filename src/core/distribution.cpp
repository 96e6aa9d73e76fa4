#include "core/distribution.h"

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

}  // namespace etd
