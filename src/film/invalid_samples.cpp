#include "film/invalid_samples.h"

namespace etd {

void InvalidSamples::take_out(const SampleId& id, PixelSample& s) {
  bool has_nan = false, has_infinity = false;
  const auto look_at = [&](float v) {
    has_nan = has_nan || std::isnan(v);
    has_infinity = has_infinity || std::isinf(v);
  };
  const Spectrum sum = s.emission + s.direct + s.indirect;
  for (const Spectrum& c : {s.emission, s.direct, s.indirect, s.albedo, sum, sum * s.weight})
    for (int i = 0; i < Spectrum::kActive; ++i) look_at(c[i]);
  for (const float v : {s.normal.x, s.normal.y, s.normal.z, s.depth, s.position.x, s.position.y, s.position.z})
    look_at(v);
  ++(has_nan ? nan : has_infinity ? infinite : negative);
  if (!first || id < *first) first = id;
  PixelSample black;
  black.rays = s.rays;
  s = black;
}

InvalidSamples& InvalidSamples::operator+=(const InvalidSamples& b) {
  nan += b.nan, infinite += b.infinite, negative += b.negative;
  if (b.first && (!first || *b.first < *first)) first = b.first;
  return *this;
}

}  // namespace etd
