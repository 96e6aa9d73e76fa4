// Which object and which material a pixel shows. Ids are names and have no mean, so a pixel has those of one sample:
// the one nearest to its centre, which is the same whatever the order in which samples are offered.
#pragma once

#include <cstdint>
#include <limits>

namespace etd {

// Counted from 1 in the order of the scene; 0: no surface.
struct SurfaceIds {
  uint32_t object = 0, material = 0;
  friend bool operator==(const SurfaceIds&, const SurfaceIds&) = default;
};

// A float tells this many apart.
inline constexpr uint32_t kMostIds = 1u << 24;

struct PixelIds {
  float distance2 = std::numeric_limits<float>::infinity();  // of the sample from the centre, in pixels, squared
  uint32_t number = 0;                                       // as in SampleId; of several as near the first
  SurfaceIds ids;

  void offer(const PixelIds& s) {
    if (s.distance2 < distance2 || (s.distance2 == distance2 && s.number < number)) *this = s;
  }
};

}  // namespace etd
