#include "film/strongest.h"

#include <algorithm>

#include "film/film.h"

namespace etd {

std::vector<SampleStrength> strongest_samples(const Film& film, size_t count) {
  const PixelBounds& crop = film.settings().crop;
  // A heap of the strongest so far, the weakest of them on top.
  const auto stronger = [](const SampleStrength& a, const SampleStrength& b) {
    return a.strength != b.strength ? a.strength > b.strength : a.id < b.id;
  };
  std::vector<SampleStrength> found;
  for (int y = crop.y0; y < crop.y1; ++y)
    for (int x = crop.x0; x < crop.x1; ++x) {
      const StrongestSample& s = film.strongest(x, y);
      if (s.luminance == 0) continue;
      const PixelSums sums = film.light(x, y);
      const double luminance = s.luminance, mean = sums.mean_radiance()[3];
      SampleStrength candidate{{x, y, s.number}, s.luminance, mean == 0 ? 0 : luminance / (sums.count * mean), 0};
      // Where negative lobes of a filter leave hardly anything of the mean, its share means nothing.
      candidate.strength = std::abs(luminance) * (mean == 0 ? 1.0 : std::min(1.0, std::abs(candidate.share)));
      found.push_back(candidate);
      std::push_heap(found.begin(), found.end(), stronger);
      if (found.size() <= count) continue;
      std::pop_heap(found.begin(), found.end(), stronger);
      found.pop_back();
    }
  std::sort_heap(found.begin(), found.end(), stronger);
  return found;
}

}  // namespace etd
