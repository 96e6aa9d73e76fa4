#include <gtest/gtest.h>

#include <set>

#include "slow_build.h"
#include "verify/battery/battery.h"
#include "verify/battery/light/light.h"

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

// None of 30 seeds fails.
TEST(SlowLightBattery, NoFalseAlarmInThirtySeeds) {
  for (uint64_t seed = 1; seed <= 30; ++seed)
    for (const BatterySubject& s : light_subjects())
      for (const CheckResult& r : s.check(options_of_seed(seed)))
        EXPECT_TRUE(r.passed) << "seed " << seed << ": " << to_string(r);
}

std::set<std::string> failures(const std::vector<CheckResult>& results) {
  std::set<std::string> names;
  for (const CheckResult& r : results)
    if (!r.passed) names.insert(r.name);
  return names;
}
std::set<std::string> failures(const LightModel& model) { return failures(check_light(model, {20000, 1, 1e-6})); }

LightModel example(const std::string& name, const EmissionDisks& disks = test_disks()) {
  for (const LightExample& e : light_examples())
    if (e.name == name) return light_model(e, disks);
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
  EXPECT_EQ(failures(m), (std::set<std::string>{"power = flux", "weight of emission = power"}));
}

// ---- emission

std::vector<CheckResult> emission(const LightModel& model, const LightBatteryOptions& options) {
  std::vector<CheckResult> results = check_emission(model, options);
  judge(results, options.family_level);
  return results;
}

// None of 20 seeds fails.
TEST(SlowLightBattery, NoFalseAlarmOfEmissionInTwentySeeds) {
  for (uint64_t seed = 1; seed <= 20; ++seed)
    for (const LightExample& e : light_examples())
      for (const CheckResult& r :
           emission(light_model(e), {20000, seed, 1e-4 / static_cast<double>(light_examples().size())}))
        EXPECT_TRUE(r.passed) << "seed " << seed << ": " << to_string(r);
}

// Returns the failures of a light whose samples are changed, and the densities that are told of them likewise.
std::set<std::string> emission_failures(LightModel m, const std::function<void(EmissionSample&)>& sample,
                                        const std::function<void(EmissionDensity&)>& density = {}) {
  m.sample_le = [=, make = m.sample_le](Vec2 u, Vec2 v) {
    auto s = make(u, v);
    if (!s) return s;
    EmissionDensity pdf{s->pdf_position, s->pdf_direction};
    if (density) density(pdf);
    s->pdf_position = pdf.position, s->pdf_direction = pdf.direction;
    if (sample) sample(*s);
    return s;
  };
  m.pdf_le = [=, tell = m.pdf_le](const SurfacePoint* s, Vec3 w, Point3 from) {
    EmissionDensity pdf = tell(s, w, from);
    if (density) density(pdf);
    return pdf;
  };
  return failures(emission(m, {20000, 1, 1e-6}));
}

TEST(LightBatteryFaults, EmissionWithoutCosine) {
  const auto f = emission_failures(example("diffuse(sphere)"), [](EmissionSample& s) { s.cosine = 1.0f; });
  EXPECT_TRUE(f.count("weight of emission = power"));
  EXPECT_TRUE(f.count("flux along lines"));
}

TEST(LightBatteryFaults, CosineDirectionsToldToBeUniform) {
  const auto f =
      emission_failures(example("diffuse(triangle)"), {}, [](EmissionDensity& pdf) { pdf.direction = 0.5f * kInvPi; });
  EXPECT_TRUE(f.count("directions follow pdf_le"));
  EXPECT_TRUE(f.count("flux along lines"));
}

TEST(LightBatteryFaults, ChoiceOfSideLeftOut) {
  const auto f =
      emission_failures(example("diffuse(sphere, two-sided)"), {}, [](EmissionDensity& pdf) { pdf.direction *= 2.0f; });
  EXPECT_TRUE(f.count("integral of pdf_le"));
  EXPECT_TRUE(f.count("weight of emission = power"));
}

TEST(LightBatteryFaults, DiskOfInfiniteLightsWithoutArea) {
  for (const char* name : {"infinite(constant)", "infinite(equal-area image)", "distant"}) {
    const auto f = emission_failures(example(name), {}, [](EmissionDensity& pdf) { pdf.position = 1.0f; });
    EXPECT_TRUE(f.count("positions follow pdf_le")) << name;
    EXPECT_TRUE(f.count("weight of emission = power")) << name;
  }
}

TEST(LightBatteryFaults, PositionDensityOff) {
  for (const char* name : {"diffuse(triangle)", "diffuse(ellipsoid)"})
    EXPECT_TRUE(emission_failures(example(name), {}, [](EmissionDensity& pdf) { pdf.position *= 1.02f; })
                    .count("weight of emission = power"))
        << name;
  // One disk gives all samples the same weight; nested ones different ones, so that it takes more to be seen.
  for (const char* name : {"infinite(constant)", "distant"})
    EXPECT_TRUE(emission_failures(example(name, EmissionDisks(kTestScene)), {},
                                  [](EmissionDensity& pdf) { pdf.position *= 1.02f; })
                    .count("weight of emission = power"))
        << name;
  for (const char* name : {"infinite(constant)", "distant"})
    EXPECT_TRUE(emission_failures(example(name), {}, [](EmissionDensity& pdf) { pdf.position *= 1.2f; })
                    .count("weight of emission = power"))
        << name;
}

TEST(LightBatteryFaults, EmitsToTheWrongSide) {
  const auto f = emission_failures(example("diffuse(triangle)"), [](EmissionSample& s) {
    s.ray.d = s.ray.d - s.on_light.ng * (2.0f * dot(s.ray.d, s.on_light.ng));
  });
  EXPECT_TRUE(f.count("emission = pdf_le, emitted"));
  EXPECT_TRUE(f.count("directions follow pdf_le"));
  EXPECT_TRUE(f.count("flux along lines"));
}

TEST(LightBatteryFaults, EmitsBackwards) {
  for (const char* name : {"infinite(equal-area image)", "goniometric", "infinite(portal, equal-area image)"})
    EXPECT_TRUE(
        emission_failures(example(name), [](EmissionSample& s) { s.ray.d = -s.ray.d; }).count("flux along lines"))
        << name;
}

TEST(LightBatteryFaults, EmitsFromOtherPlaces) {
  for (const char* name : {"diffuse(triangle)", "diffuse(cylinder)", "infinite(constant)", "distant",
                           "infinite(portal, latitude-longitude image)"}) {
    LightModel m = example(name);
    m.sample_le = [make = m.sample_le](Vec2 u, Vec2 v) { return make({u.x * u.x, u.y}, v); };
    const auto f = failures(emission(m, {20000, 1, 1e-6}));
    EXPECT_TRUE(f.count("positions follow pdf_le")) << name;
    EXPECT_TRUE(f.count("flux along lines")) << name;
  }
}

TEST(LightBatteryFaults, EmitsFromAPointBesideTheLight) {
  EXPECT_TRUE(emission_failures(example("spot"), [](EmissionSample& s) {
                s.ray.o = s.on_light.p = s.on_light.p + Vec3{0.2f, 0, 0};
              }).count("flux along lines"));
}

}  // namespace
}  // namespace etd
