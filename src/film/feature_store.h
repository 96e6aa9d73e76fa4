// The film's memory for what samples tell of the scene beside its light: sums and second moments, once for the even and
// once for the odd replicates, since reconstruction asks for two halves and their variances. They are integers, so that
// no grouping of replicates or passes changes a bit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "film/pixel_sample.h"

namespace etd {

struct FilmSettings;

class FeatureStore {
 public:
  // Keeps what the settings ask for; of a film without features, nothing.
  FeatureStore(size_t pixels, const FilmSettings& settings);

  // Adds to a half, 0 or 1. Different pixels may be added concurrently. Sums beyond the range of the integers stay at
  // its end.
  void add(size_t pixel, uint32_t half, const PixelSums& sums);
  // Adds the sums of a half to `sums`.
  void add_to(size_t pixel, uint32_t half, PixelSums& sums) const;

  static size_t bytes_for(size_t pixels, const FilmSettings& settings);

 private:
  bool features_, positions_, alpha_;
  size_t words_;                 // of a half of a pixel
  std::vector<uint64_t> store_;  // [pixel][half][word]
};

}  // namespace etd
