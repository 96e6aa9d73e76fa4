// It chooses finite lights in proportion to the luminance of their power and, a share of them, of what the viewer sees
// of it; infinite ones with a fixed share, because their power over a scene's surfaces says little about what a point
// sees of them.
#pragma once

#include "light_sampling/light_table.h"

namespace etd {

// The luminance of the light's power; 0 of one whose power is no number.
double power_of(const Light& light);

struct PowerLightSampler : LightTable {
  static constexpr const char* kName = "power";
  static constexpr const char* kDoc = "by their power";
  // Share of the samples that infinite lights get together when there are finite ones too.
  static constexpr double kInfiniteShare = 0.5;
  // Share of the samples of finite lights that go by the irradiance at the viewer: the power of a sun of any size would
  // otherwise leave nothing for the lamps.
  static constexpr double kSeenShare = 0.25;

  static PowerLightSampler create(const LightSamplerContext& context, LightSamplerData& data);
  // The probabilities, where there are finite and infinite lights of which some are seen.
  static std::vector<double> law(const LightSamplerContext& context);
};

}  // namespace etd
