// The battery over phase functions: samples against the density, its symmetry and its integral, which is 1, and the
// mean cosine that the parameter promises.
#include <fmt/format.h>

#include "core/warp.h"
#include "phase/henyey_greenstein.h"
#include "verify/battery/direction_histogram.h"
#include "verify/battery/models.h"

namespace etd {

namespace {

constexpr size_t kSamples = 50000;

const std::vector<Vec3>& directions() {
  static const std::vector<Vec3> list{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}, normalize(Vec3{0.3f, -0.5f, 0.7f})};
  return list;
}

}  // namespace

PhaseModel henyey_greenstein_model(float g) {
  const HenyeyGreenstein phase{g};
  return {fmt::format("henyeygreenstein(g {:g})", g), static_cast<double>(g),
          [phase](Vec3 wo, Vec3 wi) { return phase.p(wo, wi); },
          [phase](Vec3 wo, Vec2 u) { return phase.sample(wo, u); }};
}

std::vector<CheckResult> check_phase(const PhaseModel& m, const BatteryOptions& options) {
  const auto samples = static_cast<size_t>(options.samples * kSamples);
  Worst finite(m.name, "finite and positive", 0.0), symmetric(m.name, "p(wo, wi) = p(wi, wo)", 1e-5);
  WorstP chi_square(m.name, "samples follow p"), mass(m.name, "integral of p = 1"), mean(m.name, "mean cosine = g");
  uint64_t run = 0;
  for (const Vec3& wo : directions()) {
    const auto where = [&] { return fmt::format("wo ({:.3g}, {:.3g}, {:.3g})", wo.x, wo.y, wo.z); };
    const uint64_t seed = hash_combine(options.seed, ++run);
    HashStream numbers(hash_combine(seed, 3));
    RunningStats cosine;
    for (size_t i = 0; i < samples; ++i) {
      const float x = numbers.next_float(), y = numbers.next_float();
      const Vec3 wi = m.sample(wo, {x, y}), any = sample_sphere_uniform({y, x});
      const float p = m.p(wo, wi);
      finite.add(std::isfinite(p) && p > 0.0f && std::abs(length(wi) - 1.0f) < 1e-5f ? 0.0 : 1.0, where);
      symmetric.add_relative(m.p(wo, any), m.p(any, wo), where);
      cosine.add(-static_cast<double>(dot(wo, wi)));
    }
    for (const float x : {0.0f, 0x1p-24f, 0.5f, kOneMinusEpsilon})
      for (const float y : {0.0f, 0.5f, kOneMinusEpsilon})
        finite.add(is_finite(m.sample(wo, {x, y})) && std::isfinite(m.p(wo, m.sample(wo, {x, y}))) ? 0.0 : 1.0, where);
    const auto draw = [&](HashStream& u) -> std::optional<Vec3> {
      const float x = u.next_float(), y = u.next_float();
      return m.sample(wo, {x, y});
    };
    const DirectionDensity density{.draw = draw,
                                   .pdf = [&](Vec3 wi) { return static_cast<double>(m.p(wo, wi)); },
                                   .jumps = false,
                                   .cells = 256,
                                   .integration_error = 2e-4};
    check_direction_density(density, where(), samples, seed, chi_square, mass);
    const double z = (cosine.mean() - m.mean_cosine) / std::sqrt(cosine.variance_of_mean() + 1e-12);
    mean.add(z, normal_two_sided(z), [&] { return fmt::format("{}: {:.5f}", where(), cosine.mean()); });
  }
  std::vector<CheckResult> results{finite.result(), symmetric.result(), chi_square.result(), mass.result(),
                                   mean.result()};
  judge(results, options.family_level);
  return results;
}

std::vector<BatterySubject> phase_subjects() {
  std::vector<BatterySubject> subjects;
  for (const float g : {0.0f, 5e-4f, 0.3f, 0.9f, -0.2f, -0.85f}) {
    const PhaseModel m = henyey_greenstein_model(g);
    subjects.push_back(
        {"phase", "henyeygreenstein", m.name, [m](const BatteryOptions& options) { return check_phase(m, options); }});
  }
  return subjects;
}

}  // namespace etd
