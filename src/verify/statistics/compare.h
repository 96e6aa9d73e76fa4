// Whether two estimates are of the same image: a verdict with a probability of false alarm that is stated, and the
// evidence for it. docs/verification.md tells how often it misses and how it was calibrated.
#pragma once

#include <array>
#include <vector>

#include "verify/statistics/estimate.h"
#include "verify/statistics/statistics.h"

namespace etd {

struct CompareOptions {
  double level = 1e-4;   // probability of saying that they differ when they do not
  double tolerance = 0;  // relative difference of means that does not count
  int block = 8;         // side of the blocks in pixels
};

// Welch's test between the means over a region, in one channel.
struct RegionTest {
  PixelBounds region;
  int channel = 0;
  double a = 0, b = 0;   // the means
  double error = 0;      // standard error of their difference
  TestResult result;     // of what the difference has beyond the tolerance
  double corrected = 1;  // p-value, corrected for all tests of the verdict
};

// The p-values of a channel's blocks against the uniform distribution that they have when nothing differs: too many
// small ones mean that something does, though no block may show it by itself.
struct HistogramTest {
  static constexpr size_t kBins = 20;
  int channel = 0;
  std::array<size_t, kBins> bins{};  // of equal width in [0, 1]
  size_t blocks = 0;
  double threshold = 0;  // the most telling: `below` of the p-values are below it
  size_t below = 0;
  double p_value = 1;    // of seeing so many, for the choice of threshold already corrected
  double corrected = 1;  // for all tests of the verdict
};

struct Verdict {
  bool same = true;
  double p_value = 1;  // the smallest corrected one: they differ when it is below the level
  double level = 0;
  std::vector<RegionTest> image;          // of the whole image, R, G, B
  std::vector<RegionTest> blocks;         // those that were tested
  std::vector<HistogramTest> histograms;  // R, G, B; none when pixels are correlated or all is constant
  size_t left_out = 0;                    // tests of blocks that are constant and equal in both
  size_t not_finite = 0;                  // pixels left out because a value is no finite number
  bool not_finite_in_one = false;         // there are such pixels in one image only, which makes the images differ
};

// Estimates of one size. Where one of them is correlated both need replicates (at least 2).
Verdict compare(const Estimate& a, const Estimate& b, const CompareOptions& options = {});

}  // namespace etd
