// Samples that are no estimate of light: radiance that is not a number, infinite or negative, or features that are not
// finite. A single one would spoil its pixel for ever, so they are kept out of the film, counted and reported: each is
// a defect of a model or a scene that exceeds the range of floats.
#pragma once

#include <optional>

#include "film/pixel_sample.h"
#include "film/sample_id.h"
#include "film/sensor.h"

namespace etd {

// Whether the film may take it. What is not finite stays so in sums; the sign of the filter's weight does not matter.
inline bool is_sound(const PixelSample& s) {
  const float rest = s.normal.x + s.normal.y + s.normal.z + s.depth + s.position.x + s.position.y + s.position.z;
  return is_finite((s.emission + s.direct + s.indirect) * s.weight) && is_finite(s.albedo) && std::isfinite(rest) &&
         min_value(s.emission) >= 0 && min_value(s.direct) >= 0 && min_value(s.indirect) >= 0;
}

struct InvalidSamples {
  uint64_t nan = 0, infinite = 0, negative = 0;  // each sample once, by the first of these kinds that is in it
  std::optional<SampleId> first;                 // in the order of samples

  uint64_t total() const { return nan + infinite + negative; }
  // Counts a sample that is not sound, and makes it one that met nothing and brings no light.
  void take_out(const SampleId& id, PixelSample& s);
  InvalidSamples& operator+=(const InvalidSamples& b);
};

// Makes of a sample what the film adds up: exposed, or taken out where it is not sound or its exposure exceeds a float.
inline void admit(const SampleId& id, const Sensor& sensor, PixelSample& s, InvalidSamples& invalid) {
  const bool sound = is_sound(s);
  if (sound) sensor.expose(s);
  if (!sound || !is_finite((s.emission + s.direct + s.indirect) * s.weight)) invalid.take_out(id, s);
}

}  // namespace etd
