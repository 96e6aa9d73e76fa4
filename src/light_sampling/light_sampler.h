// Chooses one light for next-event estimation.
#pragma once

#include <vector>

#include "core/distribution.h"
#include "lights/light.h"

namespace etd {

// How likely each light is. Any choice gives the same mean, as long as every light that emits can be chosen.
enum class LightChoice : uint8_t {
  kPower,  // finite lights in proportion to the luminance of their power and, a share of them, of what the viewer sees
           // of it, infinite ones with a fixed share, because their power over a scene's surfaces says little about
           // what a point sees of them
  kUniform,  // all that emit alike
};

class LightSampler {
 public:
  // Share of the samples that infinite lights get together when there are finite ones too (kPower).
  static constexpr double kInfiniteShare = 0.5;
  // Share of the samples of finite lights that go by the irradiance at the viewer: the power of a sun of any size would
  // otherwise leave nothing for the lamps.
  static constexpr double kSeenShare = 0.25;

  // The irradiance on a sphere of cross section 1 around the viewer, as one point of the light tells it.
  static double seen(const Light& light, Point3 viewer);

  struct Choice {
    uint32_t light;
    float probability;
  };

  LightSampler() = default;
  // `viewer`: where the camera is, about.
  explicit LightSampler(std::span<const Light> lights, LightChoice choice = LightChoice::kPower, Point3 viewer = {});

  // Takes u in [0, 1) with all the bits of a double. Returns nothing when no light emits.
  std::optional<Choice> sample(double u) const;
  float probability(uint32_t light) const { return table_.probability(light); }

 private:
  AliasTable table_;
  bool any_ = false;
};

}  // namespace etd
