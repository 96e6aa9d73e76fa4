#include "light_sampling/power.h"

#include <cmath>
#include <numeric>

namespace etd {

namespace {

double or_nothing(double weight) { return std::isfinite(weight) && weight > 0.0 ? weight : 0.0; }

double sum_of(const std::vector<double>& weights) { return std::accumulate(weights.begin(), weights.end(), 0.0); }

}  // namespace

double power_of(const Light& light) { return or_nothing(static_cast<double>(luminance(light.power()))); }

namespace {

// The irradiance on a sphere of cross section 1 around the viewer, as one point of the light tells it.
double seen(const Light& light, Point3 viewer) {
  const auto s = light.sample_li(viewer, {0.5f, 0.5f}, {.time = 0.5f});
  return s ? or_nothing(static_cast<double>(luminance(s->radiance)) / static_cast<double>(s->pdf)) : 0.0;
}

}  // namespace

PowerLightSampler PowerLightSampler::create(const LightSamplerContext& context, LightSamplerData& data) {
  std::vector<double> finite, infinite, of_viewer;
  for (const Light& light : context.lights) {
    const double w = power_of(light);
    finite.push_back(light.is_infinite() ? 0.0 : w);
    infinite.push_back(light.is_infinite() ? w : 0.0);
    of_viewer.push_back(finite.back() > 0.0 ? seen(light, context.viewer) : 0.0);
  }
  const double all_finite = sum_of(finite), all_infinite = sum_of(infinite), all_seen = sum_of(of_viewer);
  if (all_finite == 0.0) return {{LightTable::make(infinite, data)}};
  std::vector<double> weights;
  for (size_t i = 0; i < context.lights.size(); ++i) {
    const double seen_share = all_seen > 0.0 ? kSeenShare : 0.0;
    const double infinite_share = all_infinite > 0.0 ? kInfiniteShare : 0.0;
    double w = (1.0 - seen_share) * finite[i] / all_finite;
    if (all_seen > 0.0) w += seen_share * of_viewer[i] / all_seen;
    w *= 1.0 - infinite_share;
    if (all_infinite > 0.0) w += infinite_share * infinite[i] / all_infinite;
    weights.push_back(w);
  }
  return {{LightTable::make(weights, data)}};
}

std::vector<double> PowerLightSampler::law(const LightSamplerContext& context) {
  double finite = 0, infinite = 0, all_seen = 0;
  for (const Light& l : context.lights) {
    (l.is_infinite() ? infinite : finite) += power_of(l);
    if (!l.is_infinite()) all_seen += seen(l, context.viewer);
  }
  std::vector<double> law;
  for (const Light& l : context.lights) {
    const double of_finite = (1 - kSeenShare) * power_of(l) / finite + kSeenShare * seen(l, context.viewer) / all_seen;
    law.push_back(l.is_infinite() ? kInfiniteShare * power_of(l) / infinite : (1 - kInfiniteShare) * of_finite);
  }
  return law;
}

}  // namespace etd
