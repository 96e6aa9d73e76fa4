#include "light_sampling/emission_sampler.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace etd {

EmissionSampler::EmissionSampler(std::span<const Light> all, const LightSampler& lights, const EmissionDisks& disks,
                                 LightChoice choice) {
  std::vector<double> flux, weights;
  for (const Light& light : all) {
    const double power = static_cast<double>(luminance(light.power()));
    const double area = light.enters_by_disks() ? sqr(static_cast<double>(disks.smallest().radius)) * disks.count() : 1;
    flux.push_back(std::isfinite(power * area) && power > 0 ? power * area : 0);
  }
  const double together = std::accumulate(flux.begin(), flux.end(), 0.0);
  for (uint32_t i = 0; i < all.size(); ++i) {
    const double by_light_sampling = static_cast<double>(lights.probability(i));
    if (choice == LightChoice::kUniform)
      weights.push_back(by_light_sampling > 0 ? 1 : 0);
    else if (together > 0 && std::isfinite(together))
      weights.push_back(kFluxShare * flux[i] / together + (1 - kFluxShare) * by_light_sampling);
    else
      weights.push_back(by_light_sampling);
  }
  any_ = std::any_of(weights.begin(), weights.end(), [](double w) { return w > 0; });
  table_ = AliasTable(weights);
}

std::optional<LightSampler::Choice> EmissionSampler::sample(double u) const {
  if (!any_) return {};
  const uint32_t light = table_.sample(u);
  return LightSampler::Choice{light, table_.probability(light)};
}

}  // namespace etd
