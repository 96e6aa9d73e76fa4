// Compensated microfacets: in a uniform surrounding nothing is lost and nothing is made, whatever the roughness.
#include "bsdfs/energy.h"

#include <gtest/gtest.h>

namespace etd {
namespace {

// What a viewer along wo sees of a surrounding of radiance n^2 (n the index around the place it comes from), over the
// n^2 of his own side: 1 if nothing is lost. By a grid of numbers that is finer where the few steep facets are.
template <class Closure>
double furnace(const Closure& c, Vec3 wo) {
  constexpr int kSteps = 96;
  HashStream rng(0);
  double sum = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j)
      for (const Lobe side : {kReflection, kTransmission}) {
        const float t = (static_cast<float>(j) + 0.5f) / kSteps;
        const Vec3 u{(static_cast<float>(i) + 0.5f) / kSteps, 1 - t * t, 0.5f};
        if (const auto s = c.sample(wo, u, TransportMode::kRadiance, rng, side))
          sum += static_cast<double>(s->weight[0] * s->eta * s->eta * 2 * t);
      }
  return sum / (kSteps * kSteps);
}

Vec3 at(float cosine, float azimuth = 0) {
  const float r = std::sqrt(1 - cosine * cosine);
  return {r * std::cos(azimuth), r * std::sin(azimuth), cosine};
}

constexpr float kCosines[] = {1.0f, 0.8f, 0.5f, 0.3f, 0.1f, 0.03f};

TEST(Energy, RoughMirrorsLoseNothing) {
  double least = 1;
  for (const float alpha : {0.01f, 0.05f, 0.1f, 0.23f, 0.5f, 0.8f, 1.0f})
    for (const float cosine : kCosines) {
      const RoughConductor rough{Spectrum(0.0f), Spectrum(0.0f), {alpha, alpha}};
      const EnergyCompensated<RoughConductor> whole{rough, &mirror_energy()};
      EXPECT_NEAR(furnace(whole, at(cosine)), 1, 0.005) << alpha << ' ' << cosine;
      least = std::min(least, furnace(rough, at(cosine)));
    }
  EXPECT_LT(least, 0.6);  // there is something to compensate
  // Straight on at alpha = 1 facets are distributed by the cosine, half of them reflect, with 2 c / (1 + c) of the
  // light.
  EXPECT_NEAR(mirror_energy().albedo(1, 1), 1 - std::log(2.0), 2e-3);
}

TEST(Energy, FrostedGlassLosesNothing) {
  for (const float eta : {1.1f, 1.5f, 2.4f, 1 / 1.5f})
    for (const float alpha : {0.05f, 0.23f, 0.5f, 1.0f})
      for (const float cosine : kCosines)
        for (const float side : {1.0f, -1.0f}) {
          const EnergyCompensated<RoughDielectric> whole{{eta, {alpha, alpha}}, &dielectric_energy(eta)};
          Vec3 wo = at(cosine);
          wo.z *= side;
          EXPECT_NEAR(furnace(whole, wo), 1, cosine < 0.1f ? 0.015 : 0.01) << eta << ' ' << alpha << ' ' << wo.z;
        }
}

// The table has one width for two.
TEST(Energy, AnisotropicMirrorsLoseLittle) {
  double worst = 0, worst_without = 0;
  for (const Vec2 alpha : {Vec2{0.1f, 0.3f}, Vec2{0.2f, 0.8f}, Vec2{0.05f, 0.5f}})
    for (const float azimuth : {0.0f, 0.8f, 1.5f})
      for (const float cosine : kCosines) {
        const RoughConductor rough{Spectrum(0.0f), Spectrum(0.0f), {alpha.x, alpha.y}};
        const EnergyCompensated<RoughConductor> whole{rough, &mirror_energy()};
        worst = std::max(worst, std::abs(furnace(whole, at(cosine, azimuth)) - 1));
        worst_without = std::max(worst_without, std::abs(furnace(rough, at(cosine, azimuth)) - 1));
      }
  EXPECT_LT(worst, 0.2);
  EXPECT_GT(worst_without, 0.35);
}

// A metal of reflectance F0 gains the share F0 of what a mirror gains.
TEST(Energy, MetalsGainInProportionToTheirReflectance) {
  const RoughConductor metal{Spectrum::rgb(0.2f, 1.0f, 1.2f), Spectrum::rgb(3.4f, 2.6f, 2.4f), {0.6f, 0.6f}};
  const Spectrum f0 = fresnel_conductor(1.0f, metal.eta, metal.k);
  for (int lane = 0; lane < 3; ++lane) {
    EXPECT_NEAR(energy_gain(metal, 0.8f)[lane], 1 + f0[lane] * 0.25f, 1e-6);
    EXPECT_EQ(energy_gain(metal, 1.0f)[lane], 1.0f);
  }
}

TEST(Energy, TablesAreMadeOnce) {
  EXPECT_EQ(&dielectric_energy(1.5f), &dielectric_energy(1.5f));
  EXPECT_NE(&dielectric_energy(1.5f), &dielectric_energy(1.6f));
}

}  // namespace
}  // namespace etd
