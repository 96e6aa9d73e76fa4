#include "verify/battery_bsdf.h"

#include <fmt/format.h>

#include "verify/battery.h"
#include "verify/bsdf_checks.h"

namespace etd {

namespace bsdf_checks {

const std::vector<Vec3>& test_directions() {
  static const std::vector<Vec3> directions = [] {
    std::vector<Vec3> list;
    const auto add = [&list](double cosine, double phi) {
      const double s = std::sqrt(1.0 - cosine * cosine);
      list.push_back(to_float(Vec3d{s * std::cos(phi), s * std::sin(phi), cosine}));
    };
    add(1.0, 0.0);
    add(0.9, 0.6);
    add(0.5, 2.5);
    add(0.3, -1.3);
    add(0.05, 0.2);
    add(1e-3, -2.0);
    add(-1.0, 0.0);
    add(-0.7, 1.1);
    add(-0.2, -0.4);
    return list;
  }();
  return directions;
}

std::string describe(Vec3 wo, TransportMode mode, Lobe sides) {
  return fmt::format("wo ({:.4g}, {:.4g}, {:.4g}){}{}", wo.x, wo.y, wo.z,
                     mode == TransportMode::kRadiance ? " radiance" : " importance",
                     sides == kBothSides ? "" : (sides == kReflection ? " reflection only" : " transmission only"));
}

}  // namespace bsdf_checks

std::vector<CheckResult> check_bsdf(const ScatterModel& model, const BsdfBatteryOptions& options) {
  std::vector<CheckResult> results;
  CheckResult traits{model.name, "traits agree with lobes", true, 0.0, {}, "", nullptr};
  if (model.traits.delta && model.has_smooth()) traits.passed = false, traits.text = "`delta` but has smooth lobes";
  results.push_back(traits);
  bsdf_checks::check_finite(model, results);
  if (model.traits.stochastic) {
    bsdf_checks::check_stochastic(model, options, results);
    judge(results, options.family_level);
    return results;
  }
  bsdf_checks::check_pointwise(model, options.seed, results);
  if (model.has_delta()) bsdf_checks::check_delta(model, results);
  bsdf_checks::check_histograms(model, options, results);
  judge(results, options.family_level);
  return results;
}

std::vector<BatterySubject> bsdf_subjects() {
  constexpr double kSamples = 100000;
  std::vector<BatterySubject> subjects;
  for (const BsdfExample& e : bsdf_examples())
    subjects.push_back(
        {"bsdf", e.name.substr(0, e.name.find('(')), e.name, [&e](const BatteryOptions& o) {
           return check_bsdf(scatter_model(e), {static_cast<size_t>(o.samples * kSamples), o.seed, o.family_level});
         }});
  return subjects;
}

}  // namespace etd
