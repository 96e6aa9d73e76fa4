// Tests of the battery itself: mistakes that people make in samplers, filters, phase functions, warps, choices of
// lights, textures and materials must be caught by the check that is meant to catch them, and what is right must pass.
#include <gtest/gtest.h>

#include <bit>
#include <set>

#include "core/warp.h"
#include "samplers/sampler.h"
#include "verify/battery/models.h"

namespace etd {
namespace {

using Names = std::set<std::string>;

// Few samples are enough for mistakes of this size.
constexpr BatteryOptions kOptions{0.2, 1, 1e-6};

Names failed(const std::vector<CheckResult>& results) {
  Names names;
  for (const CheckResult& r : results)
    if (!r.passed) names.insert(r.name);
  return names;
}

// ---- samplers

// What `fault` changes in the sampler's functions.
template <class F>
Names failed_of_sampler(const std::string& name, F fault) {
  SamplerModel m = sampler_model(name);
  m.make = [make = m.make, fault](uint64_t seed) {
    SamplerFunctions s = make(seed);
    fault(s);
    return s;
  };
  return failed(check_sampler(m, kOptions));
}

TEST(SamplerBatteryFaults, SoundModelsPass) {
  for (const char* name : {"independent", "sobol"})
    EXPECT_EQ(failed_of_sampler(name, [](SamplerFunctions&) {}), Names{}) << name;
}

TEST(SamplerBatteryFaults, SecondNumberIsTheFirst) {
  const auto fault = [](SamplerFunctions& s) { s.get_2d = [get = s.get_2d] { return Vec2{get().x, get().x}; }; };
  EXPECT_TRUE(failed_of_sampler("independent", fault).count("dimensions, pixels, replicates"));
  EXPECT_TRUE(failed_of_sampler("sobol", fault).count("elementary intervals"));
}

TEST(SamplerBatteryFaults, ReplicatesShareTheirSeed) {
  const auto fault = [](SamplerFunctions& s) {
    s.start = [start = s.start](uint64_t stream, uint32_t, uint32_t index) { start(stream, 0, index); };
  };
  EXPECT_EQ(failed_of_sampler("sobol", fault),
            (Names{"dimensions, pixels, replicates", "seeds and replicates differ"}));
}

TEST(SamplerBatteryFaults, JumpsToNoDimension) {
  const auto fault = [](SamplerFunctions& s) { s.set_dimension = [](uint32_t) {}; };
  EXPECT_EQ(failed_of_sampler("independent", fault), (Names{"dimensions, pixels, replicates", "random access"}));
}

// Scrambled point by point instead of interval by interval: uniform and independent, but stratified no more.
TEST(SamplerBatteryFaults, ScrambledWithoutKeepingIntervals) {
  const auto fault = [](SamplerFunctions& s) {
    s.get_2d = [get = s.get_2d] {
      const Vec2 u = get();
      return Vec2{u.x, HashStream(std::bit_cast<uint32_t>(u.y)).next_float()};
    };
  };
  EXPECT_EQ(failed_of_sampler("sobol", fault), (Names{"elementary intervals"}));
}

TEST(SamplerBatteryFaults, ReachesOneAndIsNotUniform) {
  const auto up_to_one = [](SamplerFunctions& s) { s.get_1d = [get = s.get_1d] { return get() * 1.0001f; }; };
  EXPECT_EQ(failed_of_sampler("independent", up_to_one), (Names{"in [0, 1)"}));
  const auto squared = [](SamplerFunctions& s) { s.get_choice = [get = s.get_choice] { return sqr(get()); }; };
  EXPECT_EQ(failed_of_sampler("independent", squared), (Names{"uniform at every index"}));
}

// ---- filters

FilterModel filter(const char* name) {
  Diagnostics diagnostics;
  return filter_model(name, make_filter({name, {}, {}}, diagnostics));
}

TEST(FilterBatteryFaults, SoundModelsPass) {
  for (const char* name : {"gaussian", "mitchell"})
    EXPECT_EQ(failed(check_filter(filter(name), kOptions)), Names{}) << name;
}

TEST(FilterBatteryFaults, WeightsTwoPercentOff) {
  FilterModel m = filter("gaussian");
  m.sample = [sample = m.sample](Vec2 u) {
    const FilterSample s = sample(u);
    return FilterSample{s.offset, 0.98f * s.weight};
  };
  EXPECT_TRUE(failed(check_filter(m, kOptions)).count("mean weight = 1"));
}

TEST(FilterBatteryFaults, NormalisedWrongly) {
  FilterModel m = filter("gaussian");
  m.eval = [eval = m.eval](Vec2 offset) { return 1.02f * eval(offset); };
  EXPECT_TRUE(failed(check_filter(m, kOptions)).count("integral = 1"));
}

TEST(FilterBatteryFaults, SamplesOfAnotherDensity) {
  FilterModel m = filter("gaussian");
  m.sample = [r = m.radius](Vec2 u) { return FilterSample{{(2 * u.x - 1) * r.x, (2 * u.y - 1) * r.y}, 1.0f}; };
  EXPECT_EQ(failed(check_filter(m, kOptions)), (Names{"weighted samples follow it"}));
}

TEST(FilterBatteryFaults, NegativeLobesTakenForPositive) {
  FilterModel m = filter("mitchell");
  m.sample = [sample = m.sample](Vec2 u) {
    const FilterSample s = sample(u);
    return FilterSample{s.offset, std::abs(s.weight)};
  };
  EXPECT_EQ(failed(check_filter(m, kOptions)), (Names{"mean weight = 1", "weighted samples follow it"}));
}

TEST(FilterBatteryFaults, BeyondItsRadiusAndDividedByZero) {
  FilterModel m = filter("gaussian");
  m.eval = [eval = m.eval](Vec2 offset) { return std::max(eval(offset), 1e-3f); };
  EXPECT_TRUE(failed(check_filter(m, kOptions)).count("zero beyond its radius"));
  m = filter("gaussian");
  m.eval = [eval = m.eval](Vec2 offset) { return eval(offset) * (offset.x / offset.x); };
  EXPECT_TRUE(failed(check_filter(m, kOptions)).count("finite"));
}

// ---- phase functions

TEST(PhaseBatteryFaults, SoundModelsPass) {
  EXPECT_EQ(failed(check_phase(henyey_greenstein_model(0.3f), kOptions)), Names{});
}

TEST(PhaseBatteryFaults, SampledBackwards) {
  PhaseModel m = henyey_greenstein_model(0.3f);
  m.sample = [sample = m.sample](Vec3 wo, Vec2 u) { return -sample(wo, u); };
  EXPECT_EQ(failed(check_phase(m, kOptions)), (Names{"mean cosine = g", "samples follow p"}));
}

// Value and samples agree with each other, and both are those of -g.
TEST(PhaseBatteryFaults, SignOfTheCosine) {
  PhaseModel m = henyey_greenstein_model(-0.3f);
  m.mean_cosine = 0.3;
  EXPECT_EQ(failed(check_phase(m, kOptions)), (Names{"mean cosine = g"}));
}

TEST(PhaseBatteryFaults, DensityTwoPercentOff) {
  for (const float factor : {0.98f, 1.02f}) {
    PhaseModel m = henyey_greenstein_model(0.3f);
    m.p = [factor, p = m.p](Vec3 wo, Vec3 wi) { return factor * p(wo, wi); };
    EXPECT_TRUE(failed(check_phase(m, kOptions)).count("integral of p = 1")) << factor;
  }
}

TEST(PhaseBatteryFaults, NotSymmetricNorPositive) {
  PhaseModel m = henyey_greenstein_model(0.3f);
  m.p = [p = m.p](Vec3 wo, Vec3 wi) { return p(wo, wi) * (1.0f + 1e-3f * wo.z); };
  EXPECT_TRUE(failed(check_phase(m, kOptions)).count("p(wo, wi) = p(wi, wo)"));
  m.p = [](Vec3 wo, Vec3 wi) { return std::max(-dot(wo, wi), 0.0f) * kInvPi; };
  EXPECT_TRUE(failed(check_phase(m, kOptions)).count("finite and positive"));
}

// ---- warps

Vec3d on_disk(float r, float phi) { return to_double(Vec3{r * std::cos(phi), r * std::sin(phi), 0.0f}); }

TEST(WarpBatteryFaults, SoundModelsPass) {
  const WarpModel disk{"polar disk", "", [](Vec2 u) { return on_disk(std::sqrt(u.x), 2 * kPi * u.y); },
                       [](Vec2) { return static_cast<double>(kInvPi); }};
  EXPECT_EQ(failed(check_warp(disk)), Names{});
}

TEST(WarpBatteryFaults, DiskWithoutRoot) {
  const WarpModel disk{"polar disk", "", [](Vec2 u) { return on_disk(u.x, 2 * kPi * u.y); },
                       [](Vec2) { return static_cast<double>(kInvPi); }};
  EXPECT_EQ(failed(check_warp(disk)), (Names{"1 / pdf = Jacobian"}));
}

// The density of the angles, not of the solid angle that they span.
TEST(WarpBatteryFaults, DensityWithoutJacobian) {
  WarpModel sphere{"sample_sphere_uniform", "", [](Vec2 u) { return to_double(sample_sphere_uniform(u)); },
                   [](Vec2) { return static_cast<double>(kInvPi * kInvPi / 2); }};
  sphere.smooth = [](Vec2 u) { return u.x > 0.04f && u.x < 0.96f; };
  EXPECT_EQ(failed(check_warp(sphere)), (Names{"1 / pdf = Jacobian"}));
}

TEST(WarpBatteryFaults, InfiniteAtTheEdge) {
  const WarpModel exponential{"exponential", "",
                              [](Vec2 u) {
                                return to_double(Vec3{-std::log(u.x), u.y, 0.0f});
                              },
                              [](Vec2 u) { return static_cast<double>(u.x); }};
  EXPECT_EQ(failed(check_warp(exponential)), (Names{"finite at the edges"}));
}

// ---- choices of lights

LightChoiceModel by_power() { return light_choice_model("power"); }

TEST(LightSamplerBatteryFaults, SoundModelsPass) { EXPECT_EQ(failed(check_light_choice(by_power())), Names{}); }

TEST(LightSamplerBatteryFaults, ChosenAlikeButWeightedByPower) {
  LightChoiceModel m = by_power();
  m.sample = [uniform = light_choice_model("uniform").sample, p = m.probability](double u, const LightReceiver* r) {
    auto choice = uniform(u, r);
    if (choice) choice->probability = p(choice->light, r);
    return choice;
  };
  EXPECT_EQ(failed(check_light_choice(m)), (Names{"shares = probabilities"}));
}

TEST(LightSamplerBatteryFaults, ProbabilityOfAnother) {
  LightChoiceModel m = by_power();
  m.sample = [sample = m.sample](double u, const LightReceiver* r) {
    auto choice = sample(u, r);
    if (choice) choice->probability *= 1.001f;
    return choice;
  };
  EXPECT_EQ(failed(check_light_choice(m)), (Names{"told with the sample"}));
}

TEST(LightSamplerBatteryFaults, AnotherLawThanPromised) {
  LightChoiceModel m = by_power();
  m.law = light_choice_model("uniform").law;
  EXPECT_EQ(failed(check_light_choice(m)), (Names{"probabilities as promised"}));
}

// Chosen by one receiver, weighted as for another.
TEST(LightSamplerBatteryFaults, ProbabilityForAnotherReceiver) {
  LightChoiceModel m = by_power();
  m.law.clear();
  m.sample = [uniform = light_choice_model("uniform").sample, power = m.sample](double u, const LightReceiver* r) {
    return r && r->p.x > 0 ? uniform(u, r) : power(u, r);
  };
  EXPECT_EQ(failed(check_light_choice(m)), (Names{"shares = probabilities", "told with the sample"}));
}

TEST(LightSamplerBatteryFaults, ALightIsLeftOut) {
  LightChoiceModel m = light_choice_model("uniform");
  m.probability = [p = m.probability](uint32_t light, const LightReceiver* r) {
    return light == 0 ? 0.0f : p(light, r);
  };
  EXPECT_TRUE(failed(check_light_choice(m)).count("every light can be chosen"));
}

// ---- textures

TEST(TextureBatteryFaults, SoundModelsPass) {
  const auto waves = [](Vec2 uv) { return Spectrum(0.5f + 0.5f * std::sin(uv.x)); };
  EXPECT_EQ(failed(check_texture({"waves", false, waves})), Names{});
  EXPECT_EQ(failed(check_texture({"waves", true, waves})), Names{});
}

TEST(TextureBatteryFaults, NotTheSameTwice) {
  const auto changing = [calls = 0](Vec2) mutable { return Spectrum(static_cast<float>(++calls % 7)); };
  EXPECT_EQ(failed(check_texture({"changing", false, changing})), (Names{"the same at the same place"}));
}

TEST(TextureBatteryFaults, InfiniteAtTheOriginOrFarAway) {
  EXPECT_EQ(failed(check_texture({"hyperbola", false, [](Vec2 uv) { return Spectrum(1.0f / uv.x); }})),
            (Names{"finite"}));
  EXPECT_EQ(failed(check_texture({"power", false, [](Vec2 uv) { return Spectrum(std::exp(uv.y)); }})),
            (Names{"finite"}));
}

TEST(TextureBatteryFaults, ANumberThatIsAColour) {
  const auto colour = [](Vec2 uv) { return Spectrum::rgb(0.1f, 0.2f, 0.0f * uv.x); };
  EXPECT_EQ(failed(check_texture({"colour", true, colour})), (Names{"a number in all lanes"}));
}

// ---- materials

ModelUse diffuse(double reflectance) {
  Param p;
  p.name = "reflectance", p.numbers = {reflectance};
  return {"diffuse", {p}, {}};
}

TEST(MaterialBatteryFaults, CannotBeMade) {
  EXPECT_EQ(failed(check_material("diffuse", diffuse(0.5), kOptions)), Names{});
  ModelUse unknown = diffuse(0.5);
  unknown.params[0].name = "reflection";
  EXPECT_EQ(failed(check_material("diffuse", unknown, kOptions)), (Names{"is made from its declaration"}));
}

TEST(MaterialBatteryFaults, SharesOfAMix) {
  const auto share_of = [](double share) {
    return failed(check_mix(
        "mix", 0.3, [share](HashStream& rng) { return rng.next_float() < share ? 1.0 : 0.0; }, kOptions));
  };
  EXPECT_EQ(share_of(0.3), Names{});
  for (const double wrong : {0.7, 0.25, 0.35, 1.0})
    EXPECT_EQ(share_of(wrong), (Names{"share of the second material"})) << wrong;
}

}  // namespace
}  // namespace etd
