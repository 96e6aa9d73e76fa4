// What the sampler of trees consists of: trees over the finite lights, one for each part of the time in which they
// move, and tables for the rest.
#pragma once

#include <vector>

#include "core/distribution.h"
#include "light_sampling/light_tree.h"

namespace etd {

struct LightForest {
  std::vector<LightTree> trees;          // of equal parts of the time from 0 to 1
  const AliasTable* infinite = nullptr;  // null: no infinite light emits
  const AliasTable* anywhere = nullptr;  // where there is no receiver; null: no light emits
  float infinite_share = 0;              // of the samples, where finite lights may reach the receiver too
  std::vector<bool> is_infinite;         // of each light

  const LightTree& at(float time) const {
    const auto count = static_cast<float>(trees.size());
    return trees[static_cast<size_t>(clamp(time * count, 0.0f, count - 1.0f))];
  }
};

}  // namespace etd
