#include "verify/battery/bsdf/bsdf.h"

#include <fmt/format.h>

#include "materials/surface_scatter.h"
#include "verify/battery/battery.h"
#include "verify/battery/bsdf/checks.h"

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

ScatterModel tilted_model(const BsdfExample& e, double degrees) {
  const double tilt = degrees * static_cast<double>(kPi) / 180.0, azimuth = 0.7;
  const Vec3 ns =
      to_float(Vec3d{std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt)});
  // Viewer and light do not change places, and importance may gain energy (Veach 1997, section 5.3.3).
  BsdfTraits traits = e.bsdf.traits();
  traits.reciprocal = traits.energy_conserving = false;
  const auto scatter = [bsdf = e.bsdf, frame = Frame::from_z(ns)] { return SurfaceScatter(bsdf, frame, {0, 0, 1}); };
  ScatterModel m{
      fmt::format("{} tilted by {}", e.name, degrees), traits, e.bsdf.lobes(), false, e.min_cos, ns, {}, {}, {}};
  m.eval_cos = [=](Vec3 wo, Vec3 wi, TransportMode mode, HashStream& rng) {
    return scatter().eval_cos(wo, wi, mode, rng);
  };
  m.pdf = [=](Vec3 wo, Vec3 wi, TransportMode mode, Lobe sides) { return scatter().pdf(wo, wi, mode, sides); };
  m.sample = [=](Vec3 wo, Vec3 u, TransportMode mode, HashStream& rng, Lobe sides) {
    return scatter().sample(wo, u, mode, rng, sides);
  };
  return m;
}

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
  // Mistakes of the rule for tilted normals are large, and the closures themselves are tested already.
  constexpr double kSamples = 100000, kTiltedSamples = 25000;
  constexpr double kTilts[] = {15, 40, 65};  // degrees, in turn
  std::vector<BatterySubject> subjects;
  const auto add = [&subjects](const BsdfExample& e, const ScatterModel& model, double samples) {
    subjects.push_back({"bsdf", e.name.substr(0, e.name.find('(')), model.name, [=](const BatteryOptions& o) {
                          return check_bsdf(model, {static_cast<size_t>(o.samples * samples), o.seed, o.family_level});
                        }});
  };
  for (const BsdfExample& e : bsdf_examples()) {
    add(e, scatter_model(e), kSamples);
    add(e, tilted_model(e, kTilts[subjects.size() / 2 % std::size(kTilts)]), kTiltedSamples);
  }
  return subjects;
}

}  // namespace etd
