// Two image files compared, all that `etendue diff` says about them: metrics always, a verdict when both tell their
// errors.
#pragma once

#include "metrics/metrics.h"
#include "verify/statistics/compare.h"

namespace etd {

struct DifferenceOptions {
  std::filesystem::path a, b;
  std::optional<Rgb> expected;  // instead of b: exact values
  // Pictures of the standard error of a and b. Where none is named, NAME-stderr.exr beside NAME.exr is taken.
  std::filesystem::path error_a, error_b;
  int runs = 8;                     // behind such a picture
  std::string layer;                // or part, instead of the picture; layers have no verdict
  std::optional<PixelBounds> crop;  // in pixels of the full image
  bool correlated = false;          // pixels are, whatever the metadata say
  MetricOptions metrics;
  CompareOptions compare;
};

struct WorstPixel {
  int x = 0, y = 0;  // in the full image
  Rgb a{}, b{};
  double share = 0;             // of the relMSE over all pixels
  std::optional<double> sigma;  // largest difference of a channel over its standard error
};

struct Difference {
  std::string name_a, name_b;
  PixelBounds region;  // that was compared, in the full image
  Picture a, b;
  bool identical = false;
  MetricTable metrics;
  std::vector<WorstPixel> worst;
  std::optional<Verdict> verdict;
  std::string no_verdict;          // why there is none
  std::vector<std::string> notes;  // what the reader has to know to believe it
};

struct DifferenceResult {
  std::optional<Difference> difference;
  std::string error;
};
DifferenceResult find_difference(const DifferenceOptions& options);

enum class Answer { kSame, kDifferent, kUnknown };
Answer answer(const Difference& difference);

// The smallest relative difference of the whole image's mean in this channel that the verdict's test would find with a
// probability of 99 %.
double detectable_difference(const RegionTest& image, double level);

// A report for people, one for programs, and a page with pictures: index.html, which holds all it shows, and those
// pictures as PNG, in a folder that is made if need be. The last returns what went wrong, or an empty string.
std::string difference_text(const Difference& difference);
std::string difference_json(const Difference& difference);
std::string write_difference_page(const Difference& difference, const std::filesystem::path& folder, double exposure);

}  // namespace etd
