#include "film/sink.h"

#include <cmath>
#include <limits>

#include "film/splat_buffer.h"

namespace etd {

void Sink::splat(int x, int y, int depth, const Spectrum& light, float filter, uint32_t number) {
  const PixelBounds& crop = film_.settings().crop;
  if (x < crop.x0 || x >= crop.x1 || y < crop.y0 || y >= crop.y1) return;
  PixelSample s;
  s.weight = filter;
  (depth == 0 ? s.emission : depth == 1 ? s.direct : s.indirect) = light;
  admit({x, y, number}, film_.settings().sensor, s, counts_.invalid);
  const Spectrum value = (s.emission + s.direct + s.indirect) * s.weight;
  if (std::abs(s.weight) * max_value(s.emission + s.direct + s.indirect) > SplatBuffer::kLargest) {
    s.emission = Spectrum(std::numeric_limits<float>::infinity());
    counts_.invalid.take_out({x, y, number}, s);
    return;
  }
  film_.splat(x, y, depth, value);
}

}  // namespace etd
