// An image as an estimate: values with what is known about their error, from a film or from files. Verdicts compare
// estimates; what they are estimates of, and who made them, does not matter.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "film/film.h"
#include "io/picture.h"

namespace etd {

// One value for each of R, G and B.
using Rgb = std::array<double, 3>;

struct Estimate {
  int width = 0, height = 0;
  std::vector<Rgb> mean;      // of each pixel, rows from the top
  std::vector<Rgb> variance;  // of that mean, estimated from the samples
  double dof = 0;             // degrees of freedom of each pixel's variance
  double samples = 0;         // behind each pixel; 0 when unknown, or when there are none because the values are exact
  // Means of the independent replicates that `mean` is made of; empty when they are not known.
  std::vector<std::vector<Rgb>> replicates;
  // Whether the errors of pixels depend on each other, as those of photons or Markov chains do. Then only the
  // replicates tell the error of a region.
  bool correlated = false;
};

// A film's picture, with its replicates.
Estimate make_estimate(const Film& film);

// An estimate, or why an image is none (one line).
struct EstimateResult {
  std::optional<Estimate> estimate;
  std::string problem;
};
// The picture of a file that Etendue wrote: error from its layer `stderr`, degrees of freedom from its metadata,
// replicates from the layers `replicate0`, `replicate1`, ... when it has them. `layer`: where the picture is
// (layer_rgb()).
EstimateResult make_estimate(const LayeredImage& image, const std::string& layer = {});
// A picture whose standard error is another picture, the spread of `runs` independent runs.
EstimateResult make_estimate(const Picture& picture, const Picture& standard_error, int runs);
// Exact values, the same in each pixel.
Estimate exact_estimate(int width, int height, const Rgb& value);

// The pixels inside bounds, which must lie within the estimate.
Estimate crop(const Estimate& estimate, const PixelBounds& bounds);

}  // namespace etd
