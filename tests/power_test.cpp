// How surely verdicts find a difference of known size between renders, and how often they see one that is not there.
// The table in docs/verification.md is what this prints.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <iostream>

#include "estimate_helper.h"
#include "render_helper.h"
#include "verify/difference/difference.h"
#include "verify/statistics/compare.h"

namespace etd {
namespace {

constexpr size_t kRenders = 12;

std::vector<Estimate> make_pool(const std::string& sampler, uint32_t spp, uint32_t replicates) {
  std::vector<Estimate> pool;
  for (size_t seed = 0; seed < kRenders; ++seed) {
    RenderOverrides o;
    o.size = {32, 32};
    o.spp = spp, o.replicates = replicates, o.seed = seed, o.sampler = sampler;
    o.features = false, o.tile_size = 8;
    o.set = {{"integrator.maxdepth", "2"}};
    pool.push_back(make_estimate(render_scene(source_path("tests/scenes/agree/textured_room.pbrt"), o)));
  }
  return pool;
}

using Bias = std::function<double(int x, int y, double size)>;

Estimate biased(Estimate e, const Bias& bias, double size) {
  for (int y = 0; y < e.height; ++y)
    for (int x = 0; x < e.width; ++x) {
      const double factor = 1 + bias(x, y, size);
      const size_t i = static_cast<size_t>(y) * static_cast<size_t>(e.width) + static_cast<size_t>(x);
      for (size_t c = 0; c < 3; ++c) e.mean[i][c] *= factor, e.variance[i][c] *= factor * factor;
    }
  return e;
}

// The share of all pairs of renders that are called different when one of them has the bias.
double detected(const std::vector<Estimate>& pool, const Bias& bias, double size) {
  double found = 0, pairs = 0;
  for (size_t j = 1; j < pool.size(); ++j) {
    const Estimate b = biased(pool[j], bias, size);
    for (size_t i = 0; i < j; ++i, ++pairs) found += compare(pool[i], b).same ? 0 : 1;
  }
  return found / pairs;
}

// A pair of equal renders raises a false alarm with a probability of 1e-4, one of 66 with at most 0.7 %: this test
// fails for one choice of seeds in 150, and the seeds are fixed. That a bias of 1 % is missed has a probability below
// 1e-6 each: the detectable difference, at 99 %, is checked to be well below it.
TEST(StatisticalPower, OfVerdictsOnRenders) {
  const std::vector<Estimate> pool = make_pool("sobol", 256, 8);
  const Verdict v = compare(pool[0], pool[1]);
  const double error = v.image[1].error / v.image[1].a;
  std::cout << fmt::format("standard error of the difference of the means: {:.3f} %\n", 100 * error);
  EXPECT_LT(error, 0.001);

  const Bias whole = [](int, int, double size) { return size; };
  const Bias block = [](int x, int y, double size) { return x / 8 == 1 && y / 8 == 2 ? size : 0; };
  const Bias signs = [](int x, int y, double size) { return (x / 8 + y / 8) % 2 == 0 ? size : -size; };
  std::cout << "  bias    everywhere  in one block  up and down in blocks\n";
  for (const double size : {0.0, 0.001, 0.002, 0.003, 0.004, 0.006, 0.008, 0.01, 0.015, 0.02, 0.03, 0.05, 0.1}) {
    std::cout << fmt::format("{:6.1f} %  {:8.0f} %  {:10.0f} %  {:10.0f} %\n", 100 * size,
                             100 * detected(pool, whole, size), 100 * detected(pool, block, size),
                             100 * detected(pool, signs, size));
  }
  EXPECT_EQ(detected(pool, whole, 0), 0);
  for (const double size : {0.01, -0.01}) EXPECT_GE(detected(pool, whole, size), 0.99) << size;
}

// Equal renders again, under each sampler, with replicates or second moments, and few samples: at the level of 1e-4 all
// 66 pairs are equal, and block p-values are not smaller than they should be (but for one choice of seeds in 10^5).
TEST(StatisticalPower, EqualRendersAreCalledEqual) {
  for (const char* sampler : {"sobol", "independent"})
    for (const uint32_t replicates : {2u, 8u}) {
      const std::vector<Estimate> pool = make_pool(sampler, 32, replicates);
      double below = 0, tests = 0;
      for (size_t j = 0; j + 1 < pool.size(); j += 2) {  // pairs that share no render
        const Verdict v = compare(pool[j], pool[j + 1]);
        EXPECT_TRUE(v.same) << sampler << ' ' << replicates << ' ' << j;
        for (const RegionTest& t : v.blocks)
          if (t.channel == 1) tests += 1, below += t.result.p_value < 0.05 ? 1 : 0;
      }
      std::cout << fmt::format("{:12} R = {}: {:.1f} % of the blocks have p < 5 %\n", sampler, replicates,
                               100 * below / tests);
      EXPECT_GT(binomial_at_least(below, tests, 0.05), 1e-5) << sampler << ' ' << replicates;
    }
}

Estimate noise(NoiseSettings s, uint64_t seed) {
  s.seed = seed;
  return make_estimate(noise_film(s));
}

// The level itself, counted: 20,000 pairs of equal estimates for each kind of noise. Each bound fails for one choice of
// seeds in a million. Takes four minutes of one core.
TEST(SlowVerdicts, RaiseFalseAlarmsNoMoreOftenThanTheirLevel) {
  constexpr uint64_t kPairs = 20000;
  const std::pair<const char*, NoiseKind> kinds[] = {{"uniform", NoiseKind::kUniform},
                                                     {"exponential", NoiseKind::kExponential},
                                                     {"rare", NoiseKind::kRare},
                                                     {"stratified", NoiseKind::kStratified}};
  constexpr double kLevels[] = {1e-2, 1e-3, 1e-4};
  double all_pairs = 0, all_alarms[3] = {};
  for (const auto& [name, kind] : kinds)
    for (const uint32_t replicates : {2u, 8u}) {
      const NoiseSettings s{.kind = kind, .side = 16, .replicates = replicates, .spp = 32};
      double alarms[3] = {};
      for (uint64_t i = 0; i < kPairs; ++i) {
        const double p = compare(noise(s, 2 * i), noise(s, 2 * i + 1)).p_value;
        for (size_t k = 0; k < 3; ++k) alarms[k] += p < kLevels[k] ? 1 : 0;
      }
      std::cout << fmt::format("{:12} R = {}: alarms at 1e-2, 1e-3, 1e-4 among {} pairs: {} {} {}\n", name, replicates,
                               kPairs, alarms[0], alarms[1], alarms[2]);
      all_pairs += kPairs;
      for (size_t k = 0; k < 3; ++k) {
        all_alarms[k] += alarms[k];
        EXPECT_GT(binomial_at_least(alarms[k], kPairs, kLevels[k]), 1e-6) << name << ' ' << replicates;
      }
    }
  for (size_t k = 0; k < 3; ++k) EXPECT_GT(binomial_at_least(all_alarms[k], all_pairs, kLevels[k]), 1e-6);
}

// What `etendue diff` says it would have found: a bias of that size, in one channel alone, is missed in at most one of
// 100 of 1000 independent pairs (another choice of seeds would exceed the bound once in 10^4), and one of 1 % never
// when less than 1 % is promised.
TEST(SlowVerdicts, FindTheDifferenceThatTheyPromise) {
  constexpr uint64_t kPairs = 1000;
  const NoiseSettings s{.spp = 1280};
  double missed = 0, one_percent_missed = 0, largest = 0;
  for (uint64_t i = 0; i < kPairs; ++i) {
    const Estimate a = noise(s, 2 * i);
    Estimate b = noise(s, 2 * i + 1);
    const double promised = detectable_difference(compare(a, b).image[1], 1e-4);
    largest = std::max(largest, promised);
    const Estimate one_percent = biased(
        b, [](int, int, double size) { return size; }, 0.01);
    for (size_t k = 0; k < b.mean.size(); ++k) b.mean[k][1] *= 1 + promised;
    missed += compare(a, b).same ? 1 : 0;
    one_percent_missed += compare(a, one_percent).same ? 1 : 0;
  }
  std::cout << fmt::format("promised difference, up to {:.2f} %: missed in {} of {} pairs; 1 %: missed in {}\n",
                           100 * largest, missed, kPairs, one_percent_missed);
  EXPECT_LT(largest, 0.01);
  EXPECT_GT(binomial_at_least(missed, kPairs, 0.01), 1e-4);
  EXPECT_GT(binomial_at_least(one_percent_missed, kPairs, 0.01), 1e-4);
}

}  // namespace
}  // namespace etd
