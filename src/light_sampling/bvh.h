// It chooses by what each light may bring to the receiver: by distance, by where the light sends its light and on which
// side of the receiver it is (light_sampling/light_tree.h). Infinite lights stand beside the tree with a fixed share.
#pragma once

#include "light_sampling/light_sampler.h"

namespace etd {

struct BvhLightSampler {
  static constexpr const char* kName = "bvh";
  static constexpr const char* kDoc = "by a tree of their bounds";
  // Share of the samples that infinite lights get together where finite ones may reach the receiver too.
  static constexpr float kInfiniteShare = 0.5f;

  const LightForest* forest = nullptr;  // null: no light emits

  static BvhLightSampler create(const LightSamplerContext& context, LightSamplerData& data);
  std::optional<LightChoice> choose(double u, const LightReceiver* receiver) const;
  float probability(uint32_t light, const LightReceiver* receiver) const;
};

}  // namespace etd
