#include "light_sampling/light_sampler.h"

namespace etd {

LightSampler::LightSampler(std::span<const Light> lights, LightChoice choice) {
  double finite = 0.0, infinite = 0.0;
  std::vector<double> weights;
  for (const Light& light : lights) {
    const double w = luminance(light.power());
    weights.push_back(std::isfinite(w) ? w : 0.0);
    if (choice == LightChoice::kUniform && weights.back() > 0.0) weights.back() = 1.0;
    (light.is_infinite() ? infinite : finite) += weights.back();
  }
  any_ = finite + infinite > 0.0;
  if (choice == LightChoice::kPower && finite > 0.0 && infinite > 0.0)
    for (size_t i = 0; i < weights.size(); ++i)
      weights[i] *= lights[i].is_infinite() ? kInfiniteShare / infinite : (1.0 - kInfiniteShare) / finite;
  table_ = AliasTable(weights);
}

std::optional<LightSampler::Choice> LightSampler::sample(double u) const {
  if (!any_) return {};
  const uint32_t light = table_.sample(u);
  return Choice{light, table_.probability(light)};
}

}  // namespace etd
