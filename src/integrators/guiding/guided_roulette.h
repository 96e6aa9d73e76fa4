// Russian roulette by what a path may still bring, against what its pixel shows (Vorba and Křivánek 2016).
#pragma once

#include <algorithm>

#include "integrators/guiding/guide.h"
#include "spectrum/spectrum.h"

namespace etd {

class GuidedRoulette {
 public:
  // Returns the probability with which a path goes on that leaves a surface in the cell (nullptr: unknown), whose
  // albedo was the last one that its pixel shows, with this throughput. `otherwise` is that where nothing is known.
  float survival(const GuideCell* cell, const Spectrum& throughput, const Spectrum& albedo, float otherwise) {
    if (!cell) return otherwise;
    if (!(shown_ > 0.0f)) {  // the first surface of which something is known stands for the pixel
      shown_ = mean_value(albedo) * cell->irradiance;
      last_ = cell->indirect;
      return otherwise;
    }
    // Cells are rough, and a path that goes into the dark is there to come back: the brighter of two in a row counts.
    const float brings = mean_value(throughput) * std::max(last_, cell->indirect);
    last_ = cell->indirect;
    return std::clamp(kMargin * brings / shown_, kLeast, 1.0f);
  }

 private:
  // Paths that may bring more than this part of what the pixel shows all go on, and some of all others.
  static constexpr float kMargin = 4.0f, kLeast = 0.1f;

  float shown_ = 0;  // pi times the radiance of the pixel, as far as it is known
  float last_ = 0;
};

}  // namespace etd
