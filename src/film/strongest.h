// The sample of each pixel that contributes most is remembered, so that an image can tell which paths its fireflies are
// made of. Eight bytes a pixel; the same whatever the order in which samples are offered.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "film/sample_id.h"

namespace etd {

class Film;

struct StrongestSample {
  float luminance = 0;  // as the film received it: with the filter's weight
  uint32_t number = 0;  // as in SampleId; of several that are as strong the first

  void offer(const StrongestSample& s) {
    const float mine = std::abs(luminance), other = std::abs(s.luminance);
    if (other > mine || (other == mine && s.number < number)) *this = s;
  }
};

// How strong a sample is among those of the whole image.
struct SampleStrength {
  SampleId id;
  float luminance = 0;
  double share = 0;     // of the pixel's mean luminance that this sample makes
  double strength = 0;  // |Y| times that share, at most |Y|
};

// The strongest sample of each pixel, the strongest of all first and `count` at most; none that is black. Strength is
// luminance times its share of the pixel: a firefly, which alone makes its pixel, stands before samples
// that are as bright as their neighbours, such as those of a lamp seen directly.
std::vector<SampleStrength> strongest_samples(const Film& film, size_t count);

}  // namespace etd
