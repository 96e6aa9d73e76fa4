#include "light_sampling/emission_sampler.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace etd {

EmissionSampler::EmissionSampler(std::span<const Light> all, const LightSampler& lights, const EmissionDisks& disks) {
  std::vector<double> flux, weights;
  for (const Light& light : all) {
    const double power = static_cast<double>(luminance(light.power()));
    const double area = light.enters_by_disks() ? sqr(static_cast<double>(disks.smallest().radius)) * disks.count() : 1;
    flux.push_back(std::isfinite(power * area) && power > 0 ? power * area : 0);
  }
  const double together = std::accumulate(flux.begin(), flux.end(), 0.0);
  const bool by_flux = together > 0 && std::isfinite(together);
  for (uint32_t i = 0; i < all.size(); ++i) {
    const double by_sampler = static_cast<double>(lights.probability(i, nullptr));
    weights.push_back(by_flux ? kFluxShare * flux[i] / together + (1 - kFluxShare) * by_sampler : by_sampler);
  }
  any_ = std::any_of(weights.begin(), weights.end(), [](double w) { return w > 0; });
  table_ = AliasTable(weights);
}

std::optional<LightChoice> EmissionSampler::sample(double u) const {
  if (!any_) return {};
  const uint32_t light = table_.sample(u);
  return LightChoice{light, table_.probability(light)};
}

}  // namespace etd
