// A choice of lights that is the same for all receivers: what a light sampler consists of that looks at no receiver.
#pragma once

#include <algorithm>

#include "light_sampling/light_sampler.h"

namespace etd {

struct LightTable {
  const AliasTable* table = nullptr;  // null: no light emits

  // Makes a choice in proportion to the weights, which are finite and not negative; `data` keeps the table.
  static const AliasTable* make(const std::vector<double>& weights, LightSamplerData& data) {
    const bool any = std::any_of(weights.begin(), weights.end(), [](double w) { return w > 0.0; });
    return any ? &data.tables.emplace_back(weights) : nullptr;
  }

  std::optional<LightChoice> choose(double u, const LightReceiver*) const {
    if (!table) return {};
    const uint32_t light = table->sample(u);
    return LightChoice{light, table->probability(light)};
  }
  float probability(uint32_t light, const LightReceiver*) const { return table ? table->probability(light) : 0.0f; }
};

}  // namespace etd
