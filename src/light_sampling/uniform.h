// It chooses all lights that emit alike.
#pragma once

#include "light_sampling/light_table.h"

namespace etd {

struct UniformLightSampler : LightTable {
  static constexpr const char* kName = "uniform";
  static constexpr const char* kDoc = "all alike";

  static UniformLightSampler create(const LightSamplerContext& context, LightSamplerData& data) {
    std::vector<double> weights;
    for (const Light& light : context.lights) {
      const float power = luminance(light.power());
      weights.push_back(std::isfinite(power) && power > 0.0f ? 1.0 : 0.0);
    }
    return {{LightTable::make(weights, data)}};
  }
  // The probabilities, where all lights emit.
  static std::vector<double> law(const LightSamplerContext& context) {
    const size_t count = context.lights.size();
    return std::vector<double>(count, 1.0 / static_cast<double>(count));
  }
};

}  // namespace etd
