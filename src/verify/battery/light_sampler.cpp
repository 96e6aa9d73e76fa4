// The battery over light samplers: each light as often as its probability says, no light that may reach left out.
#include "light_sampling/light_sampler.h"

#include <fmt/format.h>

#include <iterator>

#include "light_sampling/light_sampler_list.h"
#include "lights/examples.h"
#include "params/model_list.h"
#include "verify/battery/models.h"
#include "verify/battery/worst.h"

namespace etd {

namespace {

const std::vector<Light>& example_lights() {
  static const std::vector<Light> lights = [] {
    std::vector<Light> all;
    for (const LightExample& e : light_examples()) all.push_back(e.light);
    return all;
  }();
  return lights;
}

LightReceiver receiver(Point3 p, Vec3 n, float time) {
  SurfacePoint s;
  s.p = p;
  s.ng = s.ns = normalize(n);
  return {s, time};
}

LightReceiver opaque_receiver(Point3 p, Vec3 n, float time) {
  LightReceiver r = receiver(p, n, time);
  r.both_sides = false;
  return r;
}

// Whether one of the light's samples brings light to the receiver.
bool reaches(const Light& light, const LightReceiver& r) {
  constexpr int kSide = 8;
  for (int i = 0; i < kSide * kSide; ++i) {
    const Vec2 u{(static_cast<float>(i % kSide) + 0.5f) / kSide, (static_cast<float>(i / kSide) + 0.5f) / kSide};
    const auto s = light.sample_li(r.p, u, {r.time});
    if (s && (r.both_sides || dot(s->wi, r.n) > 0.0f)) return true;
  }
  return false;
}

}  // namespace

LightChoiceModel light_choice_model(const std::string& name) {
  const LightSamplerContext context{example_lights()};
  LightChoiceModel model{name, {}, {}, {}};
  with_named(LightSamplers{}, name, [&]<class T>(std::type_identity<T>) {
    if constexpr (requires { T::law(context); }) model.law = T::law(context);
  });
  const LightSampler sampler = make_light_sampler(name, context);
  model.sample = [sampler](double u, const LightReceiver* r) { return sampler.sample(u, r); };
  model.probability = [sampler](uint32_t light, const LightReceiver* r) { return sampler.probability(light, r); };
  return model;
}

// Walks evenly through the numbers, so that shares are exact up to a step for each light.
std::vector<CheckResult> check_light_choice(const LightChoiceModel& m) {
  Worst shares(m.name, "shares = probabilities", 1e-5), told(m.name, "told with the sample", 0.0);
  Worst law(m.name, "probabilities as promised", 1e-5), complete(m.name, "every light can be chosen", 0.0);
  const std::vector<Light>& lights = example_lights();
  constexpr int kSteps = 1 << 20;
  const LightReceiver somewhere[] = {receiver({0.2f, -0.4f, 3}, {0.3f, 0.1f, -1}, 0.25f),
                                     receiver({-40, 2, 9}, {0, 0, 1}, 0.75f),
                                     opaque_receiver({0.4f, 0.3f, -0.2f}, {1, -2, 0.3f}, 0.1f),
                                     opaque_receiver({1.5f, -1, 0.4f}, {0.2f, 1, 0.1f}, 0.6f)};
  for (int k = -1; k < static_cast<int>(std::size(somewhere)); ++k) {
    const LightReceiver* r = k < 0 ? nullptr : &somewhere[k];
    std::vector<double> share(lights.size(), 0.0);
    for (int i = 0; i < kSteps; ++i) {
      const auto c = m.sample((i + 0.5) / kSteps, r);
      if (!c) continue;
      told.add(c->probability == m.probability(c->light, r) ? 0.0 : 1.0,
               [&] { return light_examples()[c->light].name; });
      share[c->light] += 1.0 / kSteps;
    }
    for (uint32_t i = 0; i < lights.size(); ++i) {
      const auto where = [&] { return light_examples()[i].name; };
      const double p = m.probability(i, r);
      shares.add(std::abs(share[i] - p), where);
      if (!m.law.empty()) law.add(std::abs(p - m.law[i]), where);
      const bool needed = r ? reaches(lights[i], *r) : luminance(lights[i].power()) > 0.0f;
      complete.add(p > 0.0 || !needed ? 0.0 : 1.0, where);
    }
  }
  std::vector<CheckResult> results{shares.result(), told.result(), complete.result()};
  if (!m.law.empty()) results.push_back(law.result());
  return results;
}

std::vector<BatterySubject> light_sampler_subjects() {
  std::vector<BatterySubject> subjects;
  for (const LightSamplerModel& m : light_sampler_models())
    subjects.push_back({"lightsampler", m.name, m.name, [model = light_choice_model(m.name)](const BatteryOptions&) {
                          return check_light_choice(model);
                        }});
  return subjects;
}

}  // namespace etd
