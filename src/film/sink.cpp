#include "film/sink.h"

#include <limits>

namespace etd {

Sink::Splat::Splat(Sink& sink, int depth, const Spectrum& light, const SampleId& id)
    : film_(sink.film_), depth_(depth) {
  // Filters are not much larger than 1, and sums of very many splats have to fit.
  constexpr double kLargest = 1e-6 * SplatBuffer::kLargest;
  PixelSample s;
  s.direct = light;
  admit(id, film_.settings().sensor, s, sink.counts_.invalid);
  if (max_value(s.direct) > kLargest) {
    s.direct = Spectrum(std::numeric_limits<float>::infinity());
    sink.counts_.invalid.take_out(id, s);
  }
  light_ = s.direct;
}

}  // namespace etd
