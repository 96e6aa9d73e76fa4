// The battery over the choices of lights: each light as often as its probability says, no light that emits left out.
#include <fmt/format.h>

#include "light_sampling/light_sampler.h"
#include "lights/examples.h"
#include "verify/battery.h"
#include "verify/worst.h"

namespace etd {

namespace {

// Walks evenly through the numbers, so that shares are exact up to a step for each light.
std::vector<CheckResult> check_choice(const std::string& name, LightChoice choice) {
  Worst shares(name, "shares = probabilities", 1e-5), told(name, "told with the sample", 0.0);
  Worst law(name, "probabilities as promised", 1e-5), complete(name, "every light can be chosen", 0.0);
  std::vector<Light> lights;
  for (const LightExample& e : light_examples()) lights.push_back(e.light);
  const LightSampler sampler(lights, choice);
  constexpr int kSteps = 1 << 20;
  std::vector<double> share(lights.size(), 0.0);
  for (int i = 0; i < kSteps; ++i) {
    const auto c = sampler.sample((i + 0.5) / kSteps);
    if (!c) continue;
    told.add(c->probability == sampler.probability(c->light) ? 0.0 : 1.0,
             [&] { return light_examples()[c->light].name; });
    share[c->light] += 1.0 / kSteps;
  }
  double finite = 0, infinite = 0;
  for (const Light& l : lights) (l.is_infinite() ? infinite : finite) += static_cast<double>(luminance(l.power()));
  for (uint32_t i = 0; i < lights.size(); ++i) {
    const auto where = [&] { return light_examples()[i].name; };
    const double p = sampler.probability(i), power = luminance(lights[i].power());
    const double of_its_kind = lights[i].is_infinite() ? LightSampler::kInfiniteShare / infinite
                                                       : (1.0 - LightSampler::kInfiniteShare) / finite;
    shares.add(std::abs(share[i] - p), where);
    law.add(std::abs(
                p - (choice == LightChoice::kUniform ? 1.0 / static_cast<double>(lights.size()) : of_its_kind * power)),
            where);
    complete.add(p > 0.0 || power == 0.0 ? 0.0 : 1.0, where);
  }
  return {shares.result(), told.result(), law.result(), complete.result()};
}

}  // namespace

std::vector<BatterySubject> light_sampler_subjects() {
  return {{"lightsampler", "power", "power",
           [](const BatteryOptions&) { return check_choice("power", LightChoice::kPower); }},
          {"lightsampler", "uniform", "uniform",
           [](const BatteryOptions&) { return check_choice("uniform", LightChoice::kUniform); }}};
}

}  // namespace etd
