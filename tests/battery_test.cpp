// The battery of `etendue verify` over everything but closures and lights, which have suites of their own
// (bsdf_battery_test.cpp, light_battery_test.cpp), with fewer samples.
#include "verify/battery/battery.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "scene/registry.h"
#include "slow_build.h"
#include "verify/battery/parameter_grid.h"

namespace etd {
namespace {

double sample_factor(const std::string& family) {
  if (kSlowBuild) return 0.05;
  return family == "sampler" ? 0.5 : family == "camera" ? 0.4 : 0.2;
}

// One false alarm in 10^4 runs of all families; each subject may have a second run.
void expect_pass(const std::string& family) {
  size_t count = 0;
  for (const BatterySubject& s : battery_subjects()) {
    if (s.family != family) continue;
    ++count;
    const BatteryOptions options{sample_factor(s.family), 1, 1e-4 / 400};
    for (const CheckResult& r : run_subject(s, options)) EXPECT_TRUE(r.passed) << to_string(r);
  }
  EXPECT_GT(count, 0u);
  EXPECT_LE(count, 200u) << "too many for the level";
}

TEST(MaterialBattery, Passes) { expect_pass("material"); }
TEST(TextureBattery, Passes) { expect_pass("texture"); }
TEST(CameraBattery, Passes) { expect_pass("camera"); }
TEST(Filter, PassesTheBattery) { expect_pass("filter"); }
TEST(Sampler, PassesTheBattery) { expect_pass("sampler"); }
TEST(PhaseBattery, Passes) { expect_pass("phase"); }
TEST(LightSampler, PassesTheBattery) { expect_pass("lightsampler"); }
TEST(Warp, PassesTheBattery) { expect_pass("warp"); }

TEST(BatteryCoverage, EveryRegisteredModelIsASubject) {
  std::set<std::pair<std::string, std::string>> present;
  for (const BatterySubject& s : battery_subjects()) {
    present.insert({s.family, s.model});
  }
  // Those of the tests above and of the suites of closures and lights.
  std::set<std::string> families;
  for (const auto& [family, model] : present) families.insert(family);
  EXPECT_EQ(families, (std::set<std::string>{"bsdf", "camera", "filter", "light", "lightsampler", "material", "phase",
                                             "sampler", "texture", "warp"}));
  const auto expect_all = [&](Family family, const std::string& name) {
    for (const ModelDecl* decl : models(family)) {
      if (decl->name == "interface") continue;
      EXPECT_TRUE(present.count({name, decl->name})) << name << " " << decl->name;
    }
  };
  expect_all(Family::kMaterial, "material");
  expect_all(Family::kTexture, "texture");
  expect_all(Family::kLight, "light");
  expect_all(Family::kAreaLight, "light");
  expect_all(Family::kCamera, "camera");
  expect_all(Family::kFilter, "filter");
  expect_all(Family::kSampler, "sampler");
}

TEST(ParameterGrid, TakesEveryValueOfARangeAtLeastOnce) {
  const ModelDecl decl{
      Family::kMaterial,
      "m",
      "",
      {{.name = "share", .default_value = 0.5, .min = 0, .max = 1},
       {.name = "flag", .type = ParamType::kBool, .default_value = false},
       {.name = "kind", .type = ParamType::kString, .default_value = std::string("a"), .choices = {"a", "b", "c"}},
       {.name = "extra", .min = 0}}};
  std::set<double> shares;
  std::set<int> flags;
  std::set<std::string> kinds;
  size_t extras = 0;
  const std::vector<ModelUse> grid = parameter_grid(decl);
  EXPECT_EQ(setting_name(grid[0]), "m");
  for (const ModelUse& use : grid) {
    Diagnostics diagnostics;
    check_params(decl, use, diagnostics);
    EXPECT_FALSE(diagnostics.has_errors()) << diagnostics.format_all();
    if (const Param* p = use.find("share")) shares.insert(p->numbers[0]);
    if (const Param* p = use.find("flag")) flags.insert(p->integers[0]);
    if (const Param* p = use.find("kind")) kinds.insert(p->strings[0]);
    extras += use.find("extra") != nullptr;
  }
  EXPECT_EQ(shares, (std::set<double>{0, 0.5, 1}));
  EXPECT_EQ(flags.size(), 2u);
  EXPECT_EQ(kinds.size(), 3u);
  EXPECT_GE(extras, 2u);
}

// A statistical failure gets a second run, a certain one does not.
TEST(RunSubject, RepeatsOnlyWhatChanceMayHaveDone) {
  std::vector<double> samples;
  const auto subject = [&](double first_p, double second_p, bool sure) {
    return BatterySubject{"f", "m", "m", [=, &samples](const BatteryOptions& o) {
                            samples.push_back(o.samples);
                            std::vector<CheckResult> results(2);
                            results[0].p_value = o.samples > 1 ? second_p : first_p;
                            results[1].passed = !sure;
                            judge(results, o.family_level);
                            return results;
                          }};
  };
  const auto passes = [&](const BatterySubject& s) {
    samples.clear();
    const auto results = run_subject(s, {});
    return std::all_of(results.begin(), results.end(), [](const auto& r) { return r.passed; });
  };
  EXPECT_TRUE(passes(subject(0.3, 0.0, false)));
  EXPECT_EQ(samples, (std::vector<double>{1}));
  EXPECT_TRUE(passes(subject(1e-9, 0.2, false)));
  EXPECT_EQ(samples, (std::vector<double>{1, 4}));
  EXPECT_FALSE(passes(subject(1e-9, 1e-9, false)));
  EXPECT_FALSE(passes(subject(0.3, 0.3, true)));
  EXPECT_EQ(samples, (std::vector<double>{1}));
}

}  // namespace
}  // namespace etd
