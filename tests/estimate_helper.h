// Estimates whose truth and noise are known, for tests of verdicts: no scene, a few lines of random numbers.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/hash.h"
#include "verify/statistics/estimate.h"

namespace etd {

// How the samples of a pixel are distributed; all have the mean 1 times the pixel's own brightness.
enum class NoiseKind {
  kUniform,
  kExponential,
  kRare,        // 0, but one in 50 is 50
  kStratified,  // one in each of n strata of a uniform number, as low-discrepancy points are
  kShared,      // exponential, the same numbers in each block of 4 x 4 pixels
};

struct NoiseSettings {
  NoiseKind kind = NoiseKind::kExponential;
  int side = 32;
  uint32_t replicates = 8, spp = 64;
  uint64_t seed = 0;
};

// `factor(x, y)` multiplies the pixel's samples.
template <class Factor>
Film noise_film(const NoiseSettings& s, Factor&& factor) {
  Film film({.width = s.side,
             .height = s.side,
             .crop = {0, 0, s.side, s.side},
             .replicates = s.replicates,
             .features = false});
  const uint32_t n = s.spp / s.replicates;
  for (int y = 0; y < s.side; ++y)
    for (int x = 0; x < s.side; ++x) {
      const bool shared = s.kind == NoiseKind::kShared;
      const uint64_t pixel = static_cast<uint64_t>(shared ? (y / 4) * s.side + x / 4 : y * s.side + x);
      const float scale = static_cast<float>(factor(x, y)) * (0.5f + static_cast<float>((x * 7 + y * 3) % 16) / 16);
      for (uint32_t r = 0; r < s.replicates; ++r) {
        HashStream random(hash_combine(s.seed, pixel, r));
        PixelSums sums;
        for (uint32_t i = 0; i < n; ++i) {
          std::array<float, 3> v;
          for (float& value : v) {
            const float u = random.next_float();
            switch (s.kind) {
              case NoiseKind::kUniform:
                value = 2 * u;
                break;
              case NoiseKind::kRare:
                value = u < 0.02f ? 50.0f : 0.0f;
                break;
              case NoiseKind::kStratified:
                value = 2 * (static_cast<float>(i) + u) / static_cast<float>(n);
                break;
              default:
                value = -std::log(1 - u);
            }
          }
          PixelSample sample;
          sample.direct = Spectrum::rgb(scale * v[0], scale * v[1], scale * v[2]);
          sums.add(sample);
        }
        film.add(x, y, r, sums);
      }
    }
  return film;
}

inline Film noise_film(const NoiseSettings& s) {
  return noise_film(s, [](int, int) { return 1.0; });
}

}  // namespace etd
