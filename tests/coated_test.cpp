// Coats in closed form: the numbers behind them against integrals made in another way, and their values against the
// mean of the walks between the layers, which know nothing of the form.
#include <gtest/gtest.h>

#include <vector>

#include "bsdfs/coated_lambert.h"
#include "bsdfs/coated_mirror.h"
#include "bsdfs/lambert.h"
#include "bsdfs/layered.h"
#include "slow_build.h"
#include "verify/statistics/statistics.h"

namespace etd {
namespace {

Vec3 at(double cosine, double azimuth = 0) {
  const double r = std::sqrt(1 - cosine * cosine);
  return to_float(Vec3d{r * std::cos(azimuth), r * std::sin(azimuth), cosine});
}

// The mean of f over n points in the middle of even steps of [0, 1].
template <class F>
double mean_over(int n, F&& f) {
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += f((i + 0.5) / n);
  return sum / n;
}

// The integral of f from a to b, by n points that are dense at both ends.
template <class F>
double integrate(double a, double b, int n, F&& f) {
  return (b - a) * mean_over(n, [&](double x) { return 6 * x * (1 - x) * f(a + (b - a) * x * x * (3 - 2 * x)); });
}

// The share of a beam that arrives below a rough coat, by the density of the facets' normals h as it is (not of those
// that wo sees): 1/cos int D(h) (wo.h)+ (1 - F) G2 exp(-thickness / mu) dh, mu the cosine after refraction.
double entering_by_normals(double eta, double alpha, double thickness, double cosine) {
  const Vec3d wo{std::sqrt(1 - cosine * cosine), 0, cosine};
  const auto lambda = [alpha](double z) { return 0.5 * (std::sqrt(1 + alpha * alpha * (1 - z * z) / (z * z)) - 1); };
  const auto of_azimuth = [&](double phi) {
    const double cos_phi = std::cos(phi), sin_phi = std::sin(phi);
    // Normals up to those at a right angle to wo, whose slopes are alpha sqrt(1 - t^2) / t.
    const double most = cos_phi < 0 ? -cosine / (wo.x * cos_phi) / alpha : HUGE_VAL;
    return integrate(1 / std::sqrt(1 + most * most), 1, 100, [&](double t) {
      const double slope = alpha * std::sqrt(1 - t * t) / t, hz = 1 / std::sqrt(1 + slope * slope), hr = slope * hz;
      const Vec3d h{hr * cos_phi, hr * sin_phi, hz};
      const double c = dot(wo, h);
      if (!(c > 0)) return 0.0;
      const double reflectance = fresnel_dielectric(static_cast<float>(c), static_cast<float>(eta)).reflectance;
      const double cos_t = std::sqrt(1 - (1 - c * c) / (eta * eta)), mu = hz * (cos_t - c / eta) + cosine / eta;
      if (!(mu > 0)) return 0.0;
      const double g2 = 1 / (1 + lambda(cosine) + lambda(std::min(mu, 1.0)));
      return 2 * t * c / hz * (1 - reflectance) * g2 * std::exp(-thickness / mu);
    });
  };
  const double integral =
      (integrate(0, 0.5 * kPiD, 60, of_azimuth) + integrate(0.5 * kPiD, kPiD, 60, of_azimuth)) / kPiD;
  return integral / cosine;
}

TEST(CoatTable, LightThatEnters) {
  for (const float eta : {1.05f, 1.5f, 2.5f})
    for (const float alpha : {1e-3f, 0.02f, 0.1f, 0.4f, 1.0f})
      for (const float thickness : {1e-20f, 0.05f, 1.0f, 6.0f}) {
        const CoatTable table(eta, alpha, thickness);
        const double straight = entering_by_normals(eta, alpha, thickness, 1);
        for (const double cosine : {1e-3, 0.013, 0.08, 0.3, 0.7, 0.98, 1.0}) {
          const double expected = entering_by_normals(eta, alpha, thickness, cosine);
          const double tolerance = 1e-3 * (thickness <= 1 ? expected : straight);
          EXPECT_NEAR(table.shares(static_cast<float>(cosine)).entering, expected, tolerance)
              << eta << ' ' << alpha << ' ' << thickness << ' ' << cosine;
        }
      }
}

// It is estimated by the coat's own samples from below.
double returned_by_samples(const RoughDielectric& coat, float thickness) {
  HashStream unused(0);
  const auto numbers = [&](double cosine) {
    const Vec3 wo = -at(cosine);
    return mean_over(48, [&](double x) {
      return mean_over(24, [&](double y) {
        const Vec3 u{static_cast<float>(0.5 * y), static_cast<float>(1 - x * x), 0.5f};
        const auto s = coat.sample(wo, u, TransportMode::kImportance, unused, kReflection);
        return s ? 2 * x * static_cast<double>(s->weight[0] * coat_transmittance(thickness, std::abs(s->wi.z))) : 0.0;
      });
    });
  };
  const auto of_cosine = [&](double cosine) {
    const double up = coat_transmittance(thickness, static_cast<float>(cosine));
    return up > 0 ? 2 * cosine * up * numbers(cosine) : 0.0;
  };
  const double critical = std::sqrt(1 - 1 / sqr(static_cast<double>(coat.eta)));
  return integrate(0, critical, 64, of_cosine) + integrate(critical, 1, 64, of_cosine);
}

TEST(CoatTable, LightThatReturns) {
  for (const float eta : {1.05f, 1.5f, 2.5f})
    for (const float alpha : {1e-3f, 0.02f, 0.1f, 0.4f, 1.0f})
      for (const float thickness : {1e-20f, 0.5f}) {
        const CoatTable table(eta, alpha, thickness);
        const double expected = returned_by_samples(table.boundary(), thickness);
        const double sum = 1 / (1 - expected);  // over all reflections, of a white base
        EXPECT_NEAR(1 / (1 - static_cast<double>(table.means().returned)), sum, 1e-3 * sum)
            << eta << ' ' << alpha << ' ' << thickness;
      }
}

// The internal reflectance of diffuse light is 1 - (1 - F) / n^2, F being that from outside, which is 0.0918 for index
// 1.5 (Walsh 1926). The table of the least rough coat agrees.
TEST(CoatTable, SmoothCoats) {
  EXPECT_NEAR(smooth_coat_means(1.5f, 1e-20f).entering, 1 - 0.0918, 5e-5);
  for (const float eta : {1 / 1.5f, 1.33f, 1.5f, 2.5f}) {
    const CoatMeans m = smooth_coat_means(eta, 1e-20f);
    EXPECT_NEAR(m.returned, 1 - m.entering / sqr(eta), 1e-5) << eta;
  }
  for (const float thickness : {1e-20f, 0.1f, 1.0f}) {
    const CoatMeans smooth = smooth_coat_means(1.5f, thickness);
    const CoatTable rough(1.5f, 1e-3f, thickness);
    EXPECT_NEAR(rough.means().returned, smooth.returned, 2e-4) << thickness;
    EXPECT_NEAR(rough.means().entering, smooth.entering, 2e-4) << thickness;
  }
  EXPECT_EQ(smooth_coat_means(1.0f, 0.1f).returned, 0.0f);
}

// It serves to choose lobes and as a feature.
TEST(CoatTable, LightThatTheCoatReflects) {
  HashStream unused(0);
  for (const float alpha : {0.01f, 0.2f, 1.0f})
    for (const double cosine : {0.003, 0.1, 0.5, 0.9, 1.0}) {
      const CoatTable table(1.5f, alpha, 0.01f);
      const double expected = mean_over(200, [&](double x) {
        return mean_over(200, [&](double y) {
          const Vec3 u{static_cast<float>(0.5 * y), static_cast<float>(1 - x * x), 0.5f};
          const auto s = table.boundary().sample(at(cosine), u, TransportMode::kImportance, unused, kReflection);
          return s ? 2 * x * static_cast<double>(s->weight[0]) : 0.0;
        });
      });
      EXPECT_NEAR(table.shares(static_cast<float>(cosine)).reflected, expected, 0.05 * expected)
          << alpha << ' ' << cosine;
    }
}

TEST(CoatTable, EachIsMadeOnce) {
  CoatTables tables;
  const CoatTable* one = tables.find(1.5f, 0.1f, 0.01f);
  EXPECT_EQ(tables.find(1.5f, 0.1f, 0.01f), one);
  EXPECT_NE(tables.find(1.5f, 0.1f, 0.02f), one);
  EXPECT_EQ(tables.size(), 2u);
}

// ---- against the walk

struct Setting {
  float alpha, eta, thickness;  // alpha 0: smooth
  int32_t max_depth;
  Vec3 wo, wi;
};

const Spectrum kPaint = Spectrum::rgb(1.0f, 0.6f, 0.1f);

// Every value of each parameter, the others chosen at random.
std::vector<Setting> settings(int count) {
  constexpr float kAlphas[] = {0, 0.01f, 0.3f, 1}, kEtas[] = {1.1f, 1.33f, 1.5f, 2},
                  kThicknesses[] = {1e-20f, 0.05f, 0.5f, 3};
  constexpr int32_t kDepths[] = {1, 2, 3, 10, 100};
  constexpr double kCosines[] = {1, 0.8, 0.4, 0.1, 0.01};
  std::vector<Setting> list;
  HashStream rng(7);
  for (int i = 0; i < count; ++i) {
    const auto pick = [&](const auto& values) { return values[rng.next_u32() % std::size(values)]; };
    const float alpha = kAlphas[i % 4], eta = pick(kEtas), thickness = pick(kThicknesses);
    const int32_t depth = kDepths[i % 5];
    const Vec3 wo = at(pick(kCosines), rng.next_float() * 6.0);
    list.push_back({alpha, eta, thickness, depth, wo, at(pick(kCosines), rng.next_float() * 6.0)});
  }
  return list;
}

// Whether the walk's mean is the closed form's value, by a t-test of means of walks, which are nearly normal. The table
// may be 1e-3 off.
template <class Closed, class Walk>
double agreement(const Closed& closed, const Walk& walk, const Setting& s, int lane, uint64_t seed) {
  constexpr int kBatches = 40, kWalks = kSlowBuild ? 20 : 100;
  const TransportMode mode = seed % 2 ? TransportMode::kRadiance : TransportMode::kImportance;
  HashStream rng(hash_combine(seed, 11));
  const double expected = static_cast<double>(closed.eval_cos(s.wo, s.wi, mode, rng)[lane]);
  RunningStats means;
  for (int i = 0; i < kBatches; ++i) {
    double sum = 0;
    for (int k = 0; k < kWalks; ++k) sum += static_cast<double>(walk.eval_cos(s.wo, s.wi, mode, rng)[lane]);
    means.add(sum / kWalks);
  }
  const double off = means.mean() - expected, allowed = 1e-3 * expected;
  if (std::abs(off) <= allowed) return 1;
  return t_test(means, expected + std::copysign(allowed, off)).p_value;
}

// Returns the smallest p-value of all comparisons, times their number.
double worst_agreement(int count, uint64_t seed) {
  CoatTables tables;
  const Lambert paint{kPaint};
  double worst = 1;
  const std::vector<Setting> list = settings(count);
  for (size_t i = 0; i < list.size(); ++i) {
    const Setting& s = list[i];
    LayerSettings layer{Spectrum(0.0f), s.thickness, 0.0f, s.max_depth, 1};
    const int lane = static_cast<int>(i / 4 % 3);
    const uint64_t own = hash_combine(seed, static_cast<uint32_t>(i));
    double p = 1;
    if (s.alpha == 0) {
      const SmoothCoat coat{{s.eta}, s.thickness, smooth_coat_means(s.eta, s.thickness)};
      const Layered<SmoothDielectric, Lambert> walk{{s.eta}, paint, layer};
      p = agreement(CoatedLambert(coat, kPaint, s.max_depth), walk, s, lane, own);
    } else {
      const CoatTable* table = tables.find(s.eta, s.alpha, s.thickness);
      const Layered<RoughDielectric, Lambert> walk{table->boundary(), paint, layer};
      p = agreement(CoatedLambert(RoughCoat{table->boundary(), table}, kPaint, s.max_depth), walk, s, lane, own);
    }
    worst = std::min(worst, p);
    EXPECT_GT(p * count, 1e-4) << "alpha " << s.alpha << " eta " << s.eta << " thickness " << s.thickness << " depth "
                               << s.max_depth << " cosines " << s.wo.z << ' ' << s.wi.z << " lane " << lane;
  }
  return worst * count;
}

constexpr int kComparisons = 240;

// One false alarm in 10^4 seeds.
TEST(CoatedLambert, IsTheMeanOfTheWalk) { worst_agreement(kComparisons, 1); }

// Counted once: no alarm in 100 seeds, and for 2 of them the least p-value times the number of comparisons is below 0.1
// (what the table may be off makes them conservative).
TEST(SlowCoatedLambert, IsTheMeanOfTheWalkForAHundredSeeds) {
  int below = 0;
  for (uint64_t seed = 1; seed <= 100; ++seed) below += worst_agreement(kComparisons, seed) < 0.1;
  std::printf("the least p-value times their number is below 0.1 for %d of 100 seeds\n", below);
}

// A mirror under a coat reflects all energy that the terms of each depth allow.
TEST(CoatedMirror, IsTheMeanOfTheWalk) {
  const SmoothConductor metal{Spectrum::rgb(0.2f, 0.6f, 1.1f), Spectrum::rgb(3.0f, 2.0f, 1.5f)};
  HashStream rng(3);
  for (const float eta : {1 / 1.5f, 1.0f, 1.5f, 2.5f})
    for (const int32_t max_depth : {1, 2, 3, 10, 100})
      for (const double cosine : {1.0, 0.6, 0.1}) {
        LayerSettings layer{Spectrum(0.0f), 0.05f, 0.0f, max_depth, 1};
        const Layered<SmoothDielectric, SmoothConductor> walk{{eta}, metal, layer};
        const Vec3 wo = at(cosine, 0.4);
        const auto closed = CoatedMirror{{eta}, metal, layer.thickness, max_depth}.sample(
            wo, {}, TransportMode::kRadiance, rng, kBothSides);
        ASSERT_TRUE(closed);
        constexpr int kBatches = 40, kWalks = 100;
        RunningStats means;
        for (int i = 0; i < kBatches; ++i) {
          double sum = 0;
          for (int k = 0; k < kWalks; ++k) {
            const Vec3 u{rng.next_float(), rng.next_float(), rng.next_float()};
            if (const auto s = walk.sample(wo, u, TransportMode::kRadiance, rng, kBothSides))
              sum += static_cast<double>(s->weight[1]);
          }
          means.add(sum / kWalks);
        }
        // 60 tests, each at 10^-6: a false alarm for one of 16000 seeds.
        const double expected = static_cast<double>(closed->weight[1]), off = means.mean() - expected;
        if (std::abs(off) > 1e-5) {
          EXPECT_GT(t_test(means, expected).p_value, 1e-6) << eta << ' ' << max_depth << ' ' << cosine;
        }
      }
}

}  // namespace
}  // namespace etd
