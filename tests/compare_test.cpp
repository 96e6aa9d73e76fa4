// Verdicts on pairs of estimates whose truth is known: that equal ones are called equal as often as promised, whatever
// their noise, and different ones different. Seeds are fixed, so nothing here fails by chance: where a bound is
// statistical, the probability that another seed would break it is stated.
#include "verify/statistics/compare.h"

#include <gtest/gtest.h>

#include "estimate_helper.h"
#include "render/output.h"
#include "temp_folder.h"

namespace etd {
namespace {

Estimate noise(NoiseSettings s, uint64_t seed) {
  s.seed = seed;
  return make_estimate(noise_film(s));
}

// How often a p-value below `threshold` may be seen among n when its probability is that, but for one case in a
// million.
bool plausible(double count, double n, double threshold) { return binomial_at_least(count, n, threshold) > 1e-6; }

struct Tally {
  double alarms = 0, block_tests = 0;
  double below_5 = 0, below_01 = 0;  // block p-values below 5 % and 0.1 %
};

Tally compare_pairs(const NoiseSettings& a, const NoiseSettings& b, int pairs, const CompareOptions& options,
                    bool correlated = false) {
  Tally tally;
  for (int i = 0; i < pairs; ++i) {
    const uint64_t seed = 2 * static_cast<uint64_t>(i);
    Estimate x = noise(a, seed), y = noise(b, seed + 1);
    x.correlated = y.correlated = correlated;
    const Verdict v = compare(x, y, options);
    tally.alarms += v.same ? 0 : 1;
    for (const RegionTest& t : v.blocks) {
      tally.block_tests += 1;
      tally.below_5 += t.result.p_value < 0.05 ? 1 : 0;
      tally.below_01 += t.result.p_value < 0.001 ? 1 : 0;
    }
  }
  return tally;
}

// At a level of 5 % alarms are frequent enough to be counted: 60 pairs for each kind of noise.
TEST(StatisticalCompare, EqualEstimatesRaiseAlarmsNoMoreOftenThanTheLevelSays) {
  constexpr int kPairs = 60;
  for (const NoiseKind kind :
       {NoiseKind::kUniform, NoiseKind::kExponential, NoiseKind::kRare, NoiseKind::kStratified}) {
    for (const uint32_t replicates : {2u, 8u}) {
      const NoiseSettings s{.kind = kind, .replicates = replicates};
      const Tally t = compare_pairs(s, s, kPairs, {.level = 0.05});
      SCOPED_TRACE(testing::Message() << static_cast<int>(kind) << " with " << replicates << " replicates");
      EXPECT_TRUE(plausible(t.alarms, kPairs, 0.05)) << t.alarms;
      EXPECT_TRUE(plausible(t.below_5, t.block_tests, 0.05)) << t.below_5 << " of " << t.block_tests;
      EXPECT_TRUE(plausible(t.below_01, t.block_tests, 0.001)) << t.below_01 << " of " << t.block_tests;
      // The errors of light-tailed noise are not overstated either; second moments do that for stratified samples.
      if (kind == NoiseKind::kUniform || (kind == NoiseKind::kStratified && replicates == 8)) {
        EXPECT_GT(t.below_5, 0.025 * t.block_tests);
      }
    }
  }
}

// The hard case: few samples that saw nothing of what many samples know.
TEST(StatisticalCompare, FewSamplesOfRareEventsAgreeWithMany) {
  const NoiseSettings few{.kind = NoiseKind::kRare, .spp = 8}, many{.kind = NoiseKind::kRare, .spp = 512};
  const Tally t = compare_pairs(few, many, 20, {.level = 0.05});
  EXPECT_TRUE(plausible(t.alarms, 20, 0.05)) << t.alarms;
}

TEST(StatisticalCompare, CorrelatedPixelsAreJudgedByTheirReplicates) {
  const NoiseSettings s{.kind = NoiseKind::kShared, .replicates = 16};
  const Tally told = compare_pairs(s, s, 60, {.level = 0.05}, true);
  EXPECT_TRUE(plausible(told.alarms, 60, 0.05)) << told.alarms;
  EXPECT_TRUE(plausible(told.below_5, told.block_tests, 0.05)) << told.below_5 << " of " << told.block_tests;
  EXPECT_GT(told.below_5, 0.025 * told.block_tests);
  // Why it has to be told: as independent pixels the same estimates look different.
  EXPECT_GT(compare_pairs(s, s, 20, {.level = 0.05}, false).alarms, 10);
}

// The standard error of the mean is 0.08 %, so a test at this level misses 1 % with a probability below 1e-9.
TEST(StatisticalCompare, OnePercentMoreIsFound) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const NoiseSettings s{.kind = NoiseKind::kExponential, .spp = 512, .seed = 1000 + 2 * seed};
    NoiseSettings other = s;
    ++other.seed;
    const Estimate a = make_estimate(noise_film(s));
    EXPECT_FALSE(compare(a, make_estimate(noise_film(other, [](int, int) { return 1.01; }))).same) << seed;
    EXPECT_TRUE(compare(a, make_estimate(noise_film(other)), {}).same) << seed;
    EXPECT_TRUE(compare(a, make_estimate(noise_film(other, [](int, int) { return 1.01; })), {.tolerance = 0.02}).same);
  }
}

// Brighter and darker blocks in turn: the mean of the image stays, and each block is off by less than two sigmas.
TEST(StatisticalCompare, ABiasThatNoBlockShowsIsInTheHistogram) {
  const auto checkered = [](int x, int y) { return (x / 8 + y / 8) % 2 == 0 ? 1.025 : 0.975; };
  const NoiseSettings s{.kind = NoiseKind::kExponential, .side = 128, .seed = 1};
  NoiseSettings other = s;
  other.seed = 2;
  const Verdict v = compare(make_estimate(noise_film(s)), make_estimate(noise_film(other, checkered)));
  EXPECT_FALSE(v.same);
  const auto smallest = [](const auto& tests) {
    double p = 1;
    for (const auto& t : tests) p = std::min(p, t.corrected);
    return p;
  };
  EXPECT_GT(smallest(v.image), 1e-3);
  EXPECT_GT(smallest(v.blocks), 1e-4);
  EXPECT_LT(smallest(v.histograms), 1e-4);
}

TEST(Compare, AnImageIsEqualToItself) {
  const Estimate a = noise({}, 1);
  const Verdict v = compare(a, a);
  EXPECT_TRUE(v.same);
  EXPECT_EQ(v.p_value, 1);
  for (const HistogramTest& h : v.histograms) {
    EXPECT_GT(h.threshold, 0);
    EXPECT_EQ(h.below, 0u);
  }
}

TEST(Compare, OneBlockThatDiffersIsNamed) {
  const auto one_block = [](int x, int y) { return x / 8 == 2 && y / 8 == 1 ? 1.5 : 1.0; };
  const NoiseSettings s{.seed = 1}, other{.seed = 2};
  const Verdict v = compare(make_estimate(noise_film(s)), make_estimate(noise_film(other, one_block)));
  EXPECT_FALSE(v.same);
  const auto strongest = std::min_element(v.blocks.begin(), v.blocks.end(), [](const auto& a, const auto& b) {
    return a.result.p_value < b.result.p_value;
  });
  EXPECT_EQ(strongest->region, (PixelBounds{16, 8, 24, 16}));
  EXPECT_GT(strongest->result.statistic, 0);  // b is brighter
  EXPECT_LT(strongest->corrected, 1e-4);
}

// Two pixels with known variances: Welch's t and Satterthwaite's degrees of freedom by hand.
TEST(Compare, RegionsPoolPixels) {
  Estimate a = exact_estimate(2, 1, {1, 1, 1}), b = exact_estimate(2, 1, {1, 1, 1});
  a.dof = 7, b.dof = 3;
  a.variance = {{0.01, 0, 0}, {0.03, 0, 0}};
  b.variance = {{0.02, 0, 0}, {0.0, 0, 0}};
  b.mean[0][0] = 1.2;
  const Verdict v = compare(a, b);
  const RegionTest& t = v.image[0];
  const double va = 0.04 / 4, vb = 0.02 / 4, dof_a = 7 * 0.04 * 0.04 / (0.0001 + 0.0009), dof_b = 3;
  EXPECT_DOUBLE_EQ(t.a, 1.0);
  EXPECT_DOUBLE_EQ(t.b, 1.1);
  EXPECT_NEAR(t.result.statistic, (0.1 - 1.1e-6) / std::sqrt(va + vb), 1e-9);
  EXPECT_NEAR(t.result.dof, (va + vb) * (va + vb) / (va * va / dof_a + vb * vb / dof_b), 1e-9);
  EXPECT_DOUBLE_EQ(t.result.p_value, student_t_two_sided(t.result.statistic, t.result.dof));
  EXPECT_EQ(v.left_out, 2u);  // the one block in green and blue
  EXPECT_EQ(v.blocks.size(), 1u);
}

TEST(Compare, AgainstExactValuesItIsATTest) {
  const Estimate a = noise({.spp = 256}, 5);
  double mean = 0;
  for (const Rgb& p : a.mean) mean += p[0] / static_cast<double>(a.mean.size());
  // The pixels' own brightness has the mean 0.96875.
  const Verdict v = compare(a, exact_estimate(32, 32, {0.96875, 0.96875, 0.96875}), {.block = 32});
  EXPECT_TRUE(v.same);
  EXPECT_FALSE(compare(a, exact_estimate(32, 32, {1, 1, 1}), {.block = 32}).same);
  EXPECT_NEAR(v.image[0].a, mean, 1e-12);
  EXPECT_GT(v.image[0].result.dof, 3000);  // nearly 7 for each of 1024 pixels
}

TEST(Compare, ConstantRegionsAreLeftOutWhenEqualAndDifferWhenNot) {
  const Estimate a = exact_estimate(16, 8, {1, 2, 3});
  Verdict v = compare(a, a);
  EXPECT_TRUE(v.same);
  EXPECT_EQ(v.left_out, 6u);
  EXPECT_TRUE(v.histograms.empty());
  Estimate b = a;
  for (Rgb& p : b.mean) p[0] *= 1 + 1e-7;  // as rounding to float does
  EXPECT_TRUE(compare(a, b).same);
  b.mean[3][1] += 0.01;
  EXPECT_FALSE(compare(a, b).same);
}

TEST(Compare, ValuesThatAreNotFiniteInOneImageOnlyMakeADifference) {
  const Estimate a = noise({}, 1);
  Estimate b = noise({}, 2);
  b.mean[5][1] = NAN;
  Verdict v = compare(a, b);
  EXPECT_FALSE(v.same);
  EXPECT_TRUE(v.not_finite_in_one);
  EXPECT_EQ(v.not_finite, 1u);
  Estimate both = a;
  both.mean[5][2] = HUGE_VAL;
  v = compare(both, b);
  EXPECT_TRUE(v.same);
  EXPECT_FALSE(v.not_finite_in_one);
  EXPECT_EQ(v.not_finite, 1u);
}

TEST(Compare, CorrectionsByHand) {
  const std::vector<double> corrected = holm_corrected(std::vector<double>{0.01, 0.04, 0.03, 0.005});
  const std::vector<double> expected = {0.03, 0.06, 0.06, 0.02};
  for (size_t i = 0; i < 4; ++i) EXPECT_DOUBLE_EQ(corrected[i], expected[i]);
  EXPECT_EQ(holm_corrected(std::vector<double>{0.9, 0.9}), (std::vector<double>{1, 1}));
  EXPECT_NEAR(binomial_at_least(2, 3, 0.25), 3 * 0.0625 * 0.75 + 0.015625, 1e-12);
  EXPECT_EQ(binomial_at_least(0, 3, 0.25), 1);
  EXPECT_NEAR(binomial_at_least(3, 3, 0.25), 0.015625, 1e-12);
  EXPECT_EQ(binomial_at_least(4, 3, 0.25), 0);
}

LayeredImage film_image(const Film& film, int spp) {
  LayeredImage image = make_layers(film, true);
  image.metadata = {{"etendue:spp", spp}, {"etendue:replicates", static_cast<int>(film.settings().replicates)}};
  return image;
}

TEST(Estimates, FilesCarryWhatFilmsKnow) {
  for (const uint32_t replicates : {2u, 8u}) {
    const Film film = noise_film({.side = 8, .replicates = replicates, .spp = 16});
    const TempFolder folder;
    ASSERT_EQ(write_layers(folder.path() / "a.exr", film_image(film, 16)), "");
    const LayersResult read = read_layers(folder.path() / "a.exr");
    ASSERT_TRUE(read.image) << read.error;
    const EstimateResult result = make_estimate(*read.image);
    ASSERT_TRUE(result.estimate) << result.problem;
    const Estimate &e = *result.estimate, expected = make_estimate(film);
    EXPECT_EQ(e.dof, replicates == 2 ? 15 : 7);
    EXPECT_EQ(e.dof, expected.dof);
    EXPECT_EQ(e.samples, 16);
    ASSERT_EQ(e.replicates.size(), replicates);
    for (size_t i = 0; i < e.mean.size(); ++i)
      for (size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(e.mean[i][c], expected.mean[i][c], 1e-6);
        EXPECT_NEAR(e.variance[i][c], expected.variance[i][c], 1e-6);
        EXPECT_NEAR(e.replicates[1][i][c], expected.replicates[1][i][c], 1e-6);
      }
    EXPECT_EQ(crop(e, {2, 3, 4, 4}).mean[1], e.mean[3 * 8 + 3]);
    EXPECT_EQ(crop(e, {2, 3, 4, 4}).replicates[0].size(), 2u);
  }
}

TEST(Estimates, ImagesWithoutErrorSayWhy) {
  const Film film = noise_film({.side = 8, .replicates = 1, .spp = 1});
  LayeredImage image = film_image(film, 1);
  EXPECT_EQ(make_estimate(image).problem, "it has pixels with a single sample, whose error is unknown");
  image.metadata.clear();
  EXPECT_EQ(make_estimate(image).problem, "its metadata do not say from how many samples its error comes");
  image.channels = {"R", "G", "B"}, image.pixels.resize(3 * 64);
  EXPECT_EQ(make_estimate(image).problem, "it has no layer \"stderr\" that tells its error");
}

}  // namespace
}  // namespace etd
