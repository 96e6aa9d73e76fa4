#include "light_sampling/light_sampler.h"

#include <cmath>
#include <numeric>

namespace etd {

namespace {

double or_nothing(double weight) { return std::isfinite(weight) && weight > 0.0 ? weight : 0.0; }

double sum_of(const std::vector<double>& weights) { return std::accumulate(weights.begin(), weights.end(), 0.0); }

}  // namespace

double LightSampler::seen(const Light& light, Point3 viewer) {
  const auto s = light.sample_li(viewer, {0.5f, 0.5f}, {.time = 0.5f});
  return s ? or_nothing(static_cast<double>(luminance(s->radiance)) / static_cast<double>(s->pdf)) : 0.0;
}

LightSampler::LightSampler(std::span<const Light> lights, LightChoice choice, Point3 viewer) {
  std::vector<double> finite, infinite, of_viewer;
  for (const Light& light : lights) {
    double w = or_nothing(static_cast<double>(luminance(light.power())));
    if (choice == LightChoice::kUniform && w > 0.0) w = 1.0;
    finite.push_back(light.is_infinite() ? 0.0 : w);
    infinite.push_back(light.is_infinite() ? w : 0.0);
    of_viewer.push_back(finite.back() > 0.0 && choice == LightChoice::kPower ? seen(light, viewer) : 0.0);
  }
  const double all_finite = sum_of(finite), all_infinite = sum_of(infinite), all_seen = sum_of(of_viewer);
  any_ = all_finite + all_infinite > 0.0;
  std::vector<double> weights;
  for (size_t i = 0; i < lights.size(); ++i) {
    if (choice == LightChoice::kUniform || all_finite == 0.0) {
      weights.push_back(finite[i] + infinite[i]);
      continue;
    }
    const double seen_share = all_seen > 0.0 ? kSeenShare : 0.0;
    const double infinite_share = all_infinite > 0.0 ? kInfiniteShare : 0.0;
    double w = (1.0 - seen_share) * finite[i] / all_finite;
    if (all_seen > 0.0) w += seen_share * of_viewer[i] / all_seen;
    w *= 1.0 - infinite_share;
    if (all_infinite > 0.0) w += infinite_share * infinite[i] / all_infinite;
    weights.push_back(w);
  }
  table_ = AliasTable(weights);
}

std::optional<LightSampler::Choice> LightSampler::sample(double u) const {
  if (!any_) return {};
  const uint32_t light = table_.sample(u);
  return Choice{light, table_.probability(light)};
}

}  // namespace etd
