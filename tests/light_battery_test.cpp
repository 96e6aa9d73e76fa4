#include <gtest/gtest.h>

#include <set>

#include "slow_build.h"
#include "verify/battery.h"
#include "verify/battery_light.h"

namespace etd {
namespace {

// One false alarm in 10^4 runs of the whole battery.
BatteryOptions options_of_seed(uint64_t seed) {
  return {kSlowBuild ? 0.1 : 1.0, seed, 1e-4 / static_cast<double>(light_examples().size())};
}

class LightBattery : public testing::TestWithParam<size_t> {};

TEST_P(LightBattery, Passes) {
  for (const CheckResult& r : run_subject(light_subjects()[GetParam()], options_of_seed(1)))
    EXPECT_TRUE(r.passed) << to_string(r);
}

std::string test_name(const testing::TestParamInfo<size_t>& info) {
  std::string name = light_examples()[info.param].name;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Examples, LightBattery, testing::Range(size_t{0}, light_examples().size()), test_name);

TEST(LightExamples, CoverEveryLight) {
  std::set<uint32_t> kinds;
  for (const LightExample& e : light_examples()) kinds.insert(e.light.kind());
  EXPECT_EQ(kinds.size(), Light::kind_count());
}

// None of 30 seeds fails. It takes minutes: run by hand with --gtest_also_run_disabled_tests.
TEST(LightBatterySeeds, DISABLED_NoFalseAlarmInThirty) {
  for (uint64_t seed = 1; seed <= 30; ++seed)
    for (const BatterySubject& s : light_subjects())
      for (const CheckResult& r : s.check(options_of_seed(seed)))
        EXPECT_TRUE(r.passed) << "seed " << seed << ": " << to_string(r);
}

std::set<std::string> failures(const LightModel& model) {
  std::set<std::string> names;
  for (const CheckResult& r : check_light(model, {20000, 1, 1e-6}))
    if (!r.passed) names.insert(r.name);
  return names;
}

LightModel example(const std::string& name) {
  for (const LightExample& e : light_examples())
    if (e.name == name) return light_model(e);
  ADD_FAILURE() << "no example " << name;
  return {};
}

// Scales the density that both functions tell.
LightModel with_density_factor(LightModel m, float factor) {
  m.pdf_li = [factor, pdf = m.pdf_li](Point3 p, Vec3 wi, const SurfacePoint* s) { return factor * pdf(p, wi, s); };
  m.sample_li = [factor, sample = m.sample_li](Point3 p, Vec2 u) {
    auto s = sample(p, u);
    if (s) s->pdf *= factor;
    return s;
  };
  return m;
}

TEST(LightBatteryFaults, DensityTwoPercentOff) {
  for (const char* name : {"diffuse(triangle, two-sided)", "infinite(constant)"})
    EXPECT_TRUE(failures(with_density_factor(example(name), 1.02f)).count("integral of pdf_li")) << name;
}

TEST(LightBatteryFaults, DensityPerAreaTakenForSolidAngle) {
  LightModel m = example("diffuse(triangle, two-sided)");
  m.pdf_li = [](Point3, Vec3, const SurfacePoint*) { return 0.5f; };
  m.sample_li = [sample = m.sample_li](Point3 p, Vec2 u) {
    auto s = sample(p, u);
    if (s) s->pdf = 0.5f;
    return s;
  };
  const auto f = failures(m);
  EXPECT_TRUE(f.count("samples follow pdf_li"));
  EXPECT_TRUE(f.count("radiance of all directions"));
}

TEST(LightBatteryFaults, EmitsOnTheWrongSide) {
  LightModel m = example("diffuse(triangle)");
  m.emitted = [](const SurfacePoint* s, Vec3 w, Point3) { return dot(s->ng, w) < 0.0f ? Spectrum(1.0f) : Spectrum(); };
  EXPECT_TRUE(failures(m).count("radiance of all directions"));
}

TEST(LightBatteryFaults, PowerOfOneSideOnly) {
  LightModel m = example("diffuse(sphere, two-sided)");
  m.power = m.power * 0.5f;
  EXPECT_EQ(failures(m), (std::set<std::string>{"power = flux"}));
}

}  // namespace
}  // namespace etd
