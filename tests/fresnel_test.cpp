#include "bsdfs/fresnel.h"

#include <gtest/gtest.h>

#include <complex>

#include "bsdfs/dielectric.h"

namespace etd {
namespace {

// Both polarisations with complex Snell cosines in double: the textbook form, cancellation and all.
double reference_reflectance(double cos_i, std::complex<double> n) {
  const std::complex<double> cos_t = std::sqrt(1.0 - (1.0 - cos_i * cos_i) / (n * n));
  const std::complex<double> rs = (cos_i - n * cos_t) / (cos_i + n * cos_t);
  const std::complex<double> rp = (n * cos_i - cos_t) / (n * cos_i + cos_t);
  return 0.5 * (std::norm(rs) + std::norm(rp));
}

TEST(Fresnel, TextbookValuesOfGlass) {
  EXPECT_NEAR(fresnel_dielectric(1.0f, 1.5f).reflectance, 0.04f, 1e-7f);
  EXPECT_NEAR(fresnel_dielectric(1.0f, 1.0f / 1.5f).reflectance, 0.04f, 1e-7f);
  // At Brewster's angle the parallel part vanishes and the perpendicular one is ((eta^2 - 1) / (eta^2 + 1))^2.
  const float brewster = 1.0f / std::sqrt(1.0f + 1.5f * 1.5f);
  EXPECT_NEAR(fresnel_dielectric(brewster, 1.5f).reflectance, 0.5 * sqr(1.25 / 3.25), 1e-7);
  EXPECT_EQ(fresnel_dielectric(0.0f, 1.5f).reflectance, 1.0f);
}

TEST(Fresnel, TotalReflectionBeyondTheCriticalAngleOnly) {
  const double critical = std::sqrt(1.0 - 1.0 / (1.5 * 1.5));
  const DielectricBoundary beyond = fresnel_dielectric(static_cast<float>(critical - 1e-4), 1.0f / 1.5f);
  EXPECT_EQ(beyond.reflectance, 1.0f);
  EXPECT_EQ(beyond.cos_t, 0.0f);
  EXPECT_LT(fresnel_dielectric(static_cast<float>(critical + 1e-4), 1.0f / 1.5f).reflectance, 1.0f);
}

TEST(Fresnel, BothSidesOfABoundaryReflectAlike) {
  for (float eta : {1.1f, 1.5f, 2.42f}) {
    for (float c = 0.02f; c < 1.0f; c += 0.02f) {
      const DielectricBoundary in = fresnel_dielectric(c, eta);
      EXPECT_NEAR(in.reflectance, fresnel_dielectric(in.cos_t, 1.0f / eta).reflectance, 5e-5f) << eta << ' ' << c;
      EXPECT_NEAR(1.0f - sqr(in.cos_t), (1.0f - c * c) / (eta * eta), 1e-6f);
    }
  }
}

TEST(Fresnel, EqualMediaAreInvisible) {
  for (float c : {1.0f, 0.3f, 1e-6f, 0.0f}) {
    EXPECT_EQ(fresnel_dielectric(c, 1.0f).reflectance, 0.0f);
    EXPECT_EQ(fresnel_dielectric(c, 1.0f).cos_t, c);
  }
}

TEST(Fresnel, ConductorAgreesWithComplexArithmetic) {
  for (float eta : {0.05f, 0.2f, 1.0f, 1.41f, 4.0f})
    for (float k : {0.0f, 0.01f, 1.0f, 3.45f, 9.0f})
      for (float c : {1.0f, 0.999f, 0.7f, 0.3f, 0.05f, 1e-3f})
        EXPECT_NEAR(fresnel_conductor(c, eta, k), reference_reflectance(c, {eta, k}), 1e-5)
            << eta << ' ' << k << ' ' << c;
}

TEST(Fresnel, ConductorLimits) {
  // Copper at 630 nm, normal incidence: ((eta - 1)^2 + k^2) / ((eta + 1)^2 + k^2).
  EXPECT_NEAR(fresnel_conductor(1.0f, 0.21f, 3.45f), (0.79 * 0.79 + 3.45 * 3.45) / (1.21 * 1.21 + 3.45 * 3.45), 1e-6);
  for (float c : {0.0f, 1e-30f, 0.5f, 1.0f}) EXPECT_EQ(fresnel_conductor(c, 0.0f, 0.0f), 1.0f);
  EXPECT_EQ(fresnel_conductor(0.0f, 1.41f, 7.59f), 1.0f);
  EXPECT_EQ(fresnel_conductor(0.0f, 1.0f, 0.0f), 1.0f);
  EXPECT_NEAR(fresnel_conductor(0.5f, 1.0f, 0.0f), 0.0f, 1e-12f);
}

TEST(SmoothDielectric, ChoosesReflectionByItsShare) {
  const SmoothDielectric glass{1.5f};
  HashStream rng(0);
  const auto at = [&](float u, Lobe sides) {
    return glass.sample({0, 0, 1}, {0.5f, 0.5f, u}, TransportMode::kRadiance, rng, sides);
  };
  EXPECT_FALSE(at(0.039f, kBothSides)->is_transmission());
  EXPECT_TRUE(at(0.041f, kBothSides)->is_transmission());
  EXPECT_NEAR(at(0.5f, kBothSides)->weight[0], 1.0 / 2.25, 1e-6);
  EXPECT_NEAR(at(0.5f, kReflection)->weight[0], 0.04, 1e-6);
  EXPECT_EQ(at(0.5f, kReflection)->pdf, 1.0f);
  EXPECT_NEAR(at(0.01f, kTransmission)->weight[0], 0.96 / 2.25, 1e-6);
}

}  // namespace
}  // namespace etd
