// One round over the image: which samples of which replicates.
#pragma once

#include <cstdint>
#include <vector>

#include "core/bounds.h"

namespace etd {

// These are the samples that each pixel gets where not all get the same.
struct SampleRanges {
  struct Range {
    uint32_t begin = 0, end = 0;  // indices in each replicate
  };
  PixelBounds crop;
  std::vector<Range> ranges;  // of the crop's pixels, row by row

  const Range& of(int x, int y) const {
    return ranges[static_cast<size_t>(y - crop.y0) * static_cast<size_t>(crop.width()) +
                  static_cast<size_t>(x - crop.x0)];
  }
};

// The samples [begin, end) of the replicates [first_replicate, end_replicate) of every pixel, or as many of them as
// `ranges` says. What makes up a pass never depends on threads.
struct Pass {
  uint32_t index = 0;
  uint32_t begin = 0, end = 0;
  uint32_t first_replicate = 0, end_replicate = 0;
  const SampleRanges* ranges = nullptr;  // of pixels, which then continue where each has stopped; outlives the pass

  SampleRanges::Range samples(int x, int y) const {
    return ranges ? ranges->of(x, y) : SampleRanges::Range{begin, end};
  }
};

}  // namespace etd
