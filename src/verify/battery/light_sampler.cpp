// The battery over the choices of lights: each light as often as its probability says, no light that emits left out.
#include <fmt/format.h>

#include <memory>

#include "lights/examples.h"
#include "verify/battery/models.h"
#include "verify/battery/worst.h"

namespace etd {

namespace {

std::vector<Light> example_lights() {
  std::vector<Light> lights;
  for (const LightExample& e : light_examples()) lights.push_back(e.light);
  return lights;
}

}  // namespace

LightChoiceModel light_choice_model(const std::string& name, LightChoice choice) {
  const auto sampler = std::make_shared<const LightSampler>(example_lights(), choice);
  return {name, choice, [sampler](double u) { return sampler->sample(u); },
          [sampler](uint32_t light) { return sampler->probability(light); }};
}

// Walks evenly through the numbers, so that shares are exact up to a step for each light.
std::vector<CheckResult> check_light_choice(const LightChoiceModel& m) {
  Worst shares(m.name, "shares = probabilities", 1e-5), told(m.name, "told with the sample", 0.0);
  Worst law(m.name, "probabilities as promised", 1e-5), complete(m.name, "every light can be chosen", 0.0);
  const std::vector<Light> lights = example_lights();
  constexpr int kSteps = 1 << 20;
  std::vector<double> share(lights.size(), 0.0);
  for (int i = 0; i < kSteps; ++i) {
    const auto c = m.sample((i + 0.5) / kSteps);
    if (!c) continue;
    told.add(c->probability == m.probability(c->light) ? 0.0 : 1.0, [&] { return light_examples()[c->light].name; });
    share[c->light] += 1.0 / kSteps;
  }
  double finite = 0, infinite = 0, seen = 0;
  for (const Light& l : lights) {
    (l.is_infinite() ? infinite : finite) += static_cast<double>(luminance(l.power()));
    if (!l.is_infinite()) seen += LightSampler::seen(l, {});
  }
  for (uint32_t i = 0; i < lights.size(); ++i) {
    const auto where = [&] { return light_examples()[i].name; };
    const double p = m.probability(i), power = luminance(lights[i].power());
    constexpr double kSeen = LightSampler::kSeenShare;
    const double of_its_kind =
        lights[i].is_infinite() ? LightSampler::kInfiniteShare * power / infinite
                                : (1.0 - LightSampler::kInfiniteShare) *
                                      ((1 - kSeen) * power / finite + kSeen * LightSampler::seen(lights[i], {}) / seen);
    shares.add(std::abs(share[i] - p), where);
    law.add(std::abs(p - (m.choice == LightChoice::kUniform ? 1.0 / static_cast<double>(lights.size()) : of_its_kind)),
            where);
    complete.add(p > 0.0 || power == 0.0 ? 0.0 : 1.0, where);
  }
  return {shares.result(), told.result(), law.result(), complete.result()};
}

std::vector<BatterySubject> light_sampler_subjects() {
  std::vector<BatterySubject> subjects;
  for (const auto& [name, choice] : {std::pair("power", LightChoice::kPower), {"uniform", LightChoice::kUniform}})
    subjects.push_back({"lightsampler", name, name, [model = light_choice_model(name, choice)](const BatteryOptions&) {
                          return check_light_choice(model);
                        }});
  return subjects;
}

}  // namespace etd
