#include "verify/scene/extrapolate.h"

namespace etd {

Film extrapolate_to_no_radius(const Film& whole, const Film& half) {
  Film film(whole.settings());
  const PixelBounds& crop = whole.settings().crop;
  for (int y = crop.y0; y < crop.y1; ++y)
    for (int x = crop.x0; x < crop.x1; ++x)
      for (uint32_t r = 0; r < whole.settings().replicates; ++r) {
        const PixelSums a = whole.sums(x, y, r), b = half.sums(x, y, r);
        if (a.count == 0 || b.count == 0) continue;
        PixelSums sums;
        for (const auto part : {&PixelSums::emission, &PixelSums::direct, &PixelSums::indirect})
          for (size_t i = 0; i < 3; ++i)
            (sums.*part)[i] = (4 * (b.*part)[i] / b.count - (a.*part)[i] / a.count) / 3 * a.count;
        sums.count = a.count;
        film.add(x, y, r, sums);
      }
  return film;
}

}  // namespace etd
