// Tests of the battery itself: closures with the mistakes that people make must be caught, by the check that is meant
// to catch them.
#include <gtest/gtest.h>

#include <set>

#include "bsdfs/conductor.h"
#include "bsdfs/dielectric.h"
#include "bsdfs/lambert.h"
#include "verify/battery/bsdf/bsdf.h"

namespace etd {
namespace {

constexpr Lobe kDiffuseReflection = kReflection | kDiffuse;

// The names of the checks that fail; few samples are enough for mistakes of this size.
std::set<std::string> failures(const ScatterModel& model) {
  std::set<std::string> names;
  for (const CheckResult& r : check_bsdf(model, {20000, 1, 1e-6}))
    if (!r.passed) names.insert(r.name);
  return names;
}

using Names = std::set<std::string>;
ScatterModel lambert(float albedo) { return scatter_model("lambert", Lambert{Spectrum(albedo)}, Lambert::kTraits); }
ScatterModel glass() { return scatter_model("glass", SmoothDielectric{1.5f}, SmoothDielectric::kTraits, true); }
RoughConductor rough_mirror(float alpha) { return {Spectrum(0.0f), Spectrum(0.0f), {alpha, alpha}}; }

// Makes sample() consistent with pdf() and eval_cos() of the model, so that only their truth is in question.
void use_own_density_and_value(ScatterModel& m) {
  m.sample = [pdf = m.pdf, eval = m.eval_cos, sample = m.sample](Vec3 wo, Vec3 u, TransportMode mode, HashStream& rng,
                                                                 Lobe sides) {
    auto s = sample(wo, u, mode, rng, sides);
    if (!s) return s;
    s->pdf = pdf(wo, s->wi, mode, sides);
    s->weight = eval(wo, s->wi, mode, rng) / s->pdf;
    return s;
  };
}

TEST(BatteryFaults, SoundModelsPass) {
  EXPECT_EQ(failures(lambert(0.7f)), Names{});
  EXPECT_EQ(failures(glass()), Names{});
  EXPECT_EQ(failures(scatter_model("rough", rough_mirror(0.3f), RoughConductor::kTraits)), Names{});
}

TEST(BatteryFaults, DroppedCosine) {
  ScatterModel m = lambert(0.4f);
  m.eval_cos = [](Vec3 wo, Vec3 wi, TransportMode, HashStream&) {
    return same_hemisphere(wo, wi) ? Spectrum(0.4f * kInvPi) : Spectrum();
  };
  EXPECT_EQ(failures(m),
            (Names{"weight * pdf = eval_cos", "mean weight = albedo", "reciprocity", "importance is adjoint"}));
}

TEST(BatteryFaults, DensityTwoPercentOff) {
  for (float factor : {1.02f, 0.98f}) {
    ScatterModel m = lambert(0.4f);
    m.pdf = [factor, pdf = m.pdf](Vec3 wo, Vec3 wi, TransportMode mode, Lobe sides) {
      return factor * pdf(wo, wi, mode, sides);
    };
    use_own_density_and_value(m);
    EXPECT_TRUE(failures(m).count("integral of pdf = 1 - failures")) << factor;
    EXPECT_TRUE(failures(m).count("mean weight = albedo")) << factor;
  }
}

TEST(BatteryFaults, WrongJacobianOfReflection) {
  const RoughConductor rough = rough_mirror(0.5f);
  ScatterModel m = scatter_model("rough", rough, RoughConductor::kTraits);
  // The density of normals taken for that of directions: 4 (wo . h) is missing.
  m.pdf = [rough](Vec3 wo, Vec3 wi, TransportMode mode, Lobe sides) {
    return rough.pdf(wo, wi, mode, sides) * 2.0f * length(wo + wi);
  };
  use_own_density_and_value(m);
  const Names f = failures(m);
  EXPECT_TRUE(f.count("samples follow pdf"));
  EXPECT_TRUE(f.count("integral of pdf = 1 - failures"));
}

TEST(BatteryFaults, SamplesOfAnotherDensity) {
  ScatterModel m = lambert(0.4f);
  m.sample = [](Vec3 wo, Vec3 u, TransportMode, HashStream&, Lobe sides) -> std::optional<BsdfSample> {
    if (!(sides & kReflection)) return {};
    Vec3 wi = sample_sphere_uniform({u.x, u.y});
    wi.z = std::copysign(std::max(std::abs(wi.z), 1e-6f), wo.z);
    return BsdfSample{wi, Spectrum(0.4f), pdf_hemisphere_cosine(std::abs(wi.z)), kDiffuseReflection, 1.0f};
  };
  EXPECT_TRUE(failures(m).count("samples follow pdf"));
}

TEST(BatteryFaults, PartOfTheSphereIsNeverSampled) {
  ScatterModel m = lambert(0.4f);
  m.pdf = [](Vec3 wo, Vec3 wi, TransportMode, Lobe sides) {
    return (sides & kReflection) && same_hemisphere(wo, wi) && wi.x >= 0.0f ? 2.0f * kInvPi * std::abs(wi.z) : 0.0f;
  };
  m.sample = [sample = m.sample](Vec3 wo, Vec3 u, TransportMode mode, HashStream& rng, Lobe sides) {
    auto s = sample(wo, u, mode, rng, sides);
    if (!s) return s;
    s->wi.x = std::abs(s->wi.x);
    s->pdf *= 2.0f;
    s->weight = s->weight * 0.5f;
    return s;
  };
  EXPECT_EQ(failures(m), (Names{"mean weight = albedo"}));
}

TEST(BatteryFaults, NotReciprocalNorAdjoint) {
  ScatterModel m = lambert(0.4f);
  m.eval_cos = [eval = m.eval_cos](Vec3 wo, Vec3 wi, TransportMode mode, HashStream& rng) {
    return eval(wo, wi, mode, rng) * (1.0f + 0.1f * std::abs(wo.z));
  };
  use_own_density_and_value(m);
  EXPECT_EQ(failures(m), (Names{"reciprocity", "importance is adjoint"}));
}

TEST(BatteryFaults, MoreEnergyThanArrives) {
  EXPECT_EQ(failures(lambert(1.01f)), (Names{"energy <= 1"}));
  ScatterModel m = lambert(0.99f);
  m.lossless = true;
  EXPECT_EQ(failures(m), (Names{"furnace = 1"}));
}

TEST(BatteryFaults, DivisionByTheCosineAtTheHorizon) {
  ScatterModel m = lambert(0.4f);
  m.eval_cos = [eval = m.eval_cos](Vec3 wo, Vec3 wi, TransportMode mode, HashStream& rng) {
    return eval(wo, wi, mode, rng) * (wo.z / wo.z);
  };
  EXPECT_EQ(failures(m), (Names{"finite and non-negative"}));
}

TEST(BatteryFaults, IgnoresTheAllowedSides) {
  ScatterModel m = lambert(0.4f);
  m.sample = [sample = m.sample](Vec3 wo, Vec3 u, TransportMode mode, HashStream& rng, Lobe) {
    return sample(wo, u, mode, rng, kBothSides);
  };
  EXPECT_TRUE(failures(m).count("only allowed sides"));
}

// Applies `fault` to the delta samples of glass.
template <class F>
ScatterModel faulty_glass(F fault) {
  ScatterModel m = glass();
  m.sample = [sample = m.sample, fault](Vec3 wo, Vec3 u, TransportMode mode, HashStream& rng, Lobe sides) {
    auto s = sample(wo, u, mode, rng, sides);
    if (s) fault(*s, mode);
    return s;
  };
  return m;
}

TEST(BatteryFaults, DeltaLobes) {
  const auto half = [](BsdfSample& s, TransportMode) { s.pdf = 0.5f; };
  EXPECT_TRUE(failures(faulty_glass(half)).count("delta probabilities"));

  const auto unscaled = [](BsdfSample& s, TransportMode mode) {
    if (mode == TransportMode::kRadiance) s.weight = s.weight * (s.eta * s.eta);
  };
  EXPECT_EQ(failures(faulty_glass(unscaled)), (Names{"delta radiance / importance"}));

  const auto scaled_always = [](BsdfSample& s, TransportMode mode) {
    if (mode == TransportMode::kImportance) s.weight = s.weight / (s.eta * s.eta);
  };
  const Names f = failures(faulty_glass(scaled_always));
  EXPECT_TRUE(f.count("furnace = 1") && f.count("energy <= 1") && f.count("delta reciprocity"));

  const auto inverted_eta = [](BsdfSample& s, TransportMode) { s.eta = 1.0f / s.eta; };
  EXPECT_TRUE(failures(faulty_glass(inverted_eta)).count("delta directions (Snell)"));

  const auto not_unit = [](BsdfSample& s, TransportMode) { s.wi.z *= 1.001f; };
  EXPECT_TRUE(failures(faulty_glass(not_unit)).count("unit wi, lobes as declared"));
}

TEST(BatteryFaults, UntrueTraits) {
  ScatterModel m = lambert(0.4f);
  m.traits.delta = true;
  EXPECT_EQ(failures(m), (Names{"traits agree with lobes"}));
}

}  // namespace
}  // namespace etd
