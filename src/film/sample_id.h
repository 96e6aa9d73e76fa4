// The name of one sample of an image, by which it can be drawn again alone.
#pragma once

#include <cstdint>
#include <tuple>

namespace etd {

struct SampleId {
  int x = 0, y = 0;     // pixel, in the full image
  uint32_t number = 0;  // of the pixel's samples: index number / R of replicate number % R

  // Samples are in the order in which passes take them, rows of an image from the top.
  friend bool operator<(const SampleId& a, const SampleId& b) {
    return std::tie(a.number, a.y, a.x) < std::tie(b.number, b.y, b.x);
  }
  friend bool operator==(const SampleId&, const SampleId&) = default;
};

}  // namespace etd
