// Chooses the light at which a path from the lights starts.
#pragma once

#include "light_sampling/light_sampler.h"
#include "lights/emission_disks.h"

namespace etd {

class EmissionSampler {
 public:
  // Share of the paths that start in proportion to flux: of finite lights their power, of infinite ones the flux
  // through the smallest disk, times the number of disks, because so many paths are begun for each that goes there. The
  // others are shared as the sampler of lights does without a receiver, so that a lamp in a room has some of its own
  // whatever shines outside.
  static constexpr double kFluxShare = 0.75;

  EmissionSampler(std::span<const Light> all, const LightSampler& lights, const EmissionDisks& disks);

  // Takes u in [0, 1) with all the bits of a double. Returns nothing when no light emits.
  std::optional<LightChoice> sample(double u) const;

 private:
  AliasTable table_;
  bool any_ = false;
};

}  // namespace etd
