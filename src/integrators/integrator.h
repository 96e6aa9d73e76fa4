// The interface between algorithms and the driver. An integrator knows the scene and how to draw samples, and nothing
// about files, threads or windows: it cuts each pass into work items, and the driver runs them in any order on any
// number of threads.
#pragma once

#include <string>

#include "film/film.h"
#include "film/invalid_samples.h"

namespace etd {

// What an algorithm promises, and so what the driver may do with it.
struct IntegratorTraits {
  bool memoryless = true;  // a sample depends only on its own numbers
  bool splats = false;     // contributes to pixels other than those of its work item
  bool biased = false;
  bool has_state = false;  // must be saved with a checkpoint
};

// The samples [begin, end) of each replicate of every pixel. The schedule of passes depends on sample indices alone.
struct Pass {
  uint32_t index = 0;
  uint32_t begin = 0, end = 0;
};

struct PathRecord;

// What happened in a work item beside what the film holds; sums do not depend on the order of the items.
struct ItemCounts {
  RayCounts rays;
  InvalidSamples invalid;
};

class Integrator {
 public:
  virtual ~Integrator() = default;
  virtual IntegratorTraits traits() const = 0;
  // What makes the image differ from the unbiased answer, for its metadata; empty when nothing does.
  virtual std::string bias() const { return {}; }
  virtual void prepare(const Pass&) {}
  virtual size_t work_items(const Pass& pass) const = 0;
  // Runs one item. Items of a pass never touch the same pixel.
  virtual void render(const Pass& pass, size_t item, Film& film, ItemCounts& counts) const = 0;
  virtual void end(const Pass&) {}
  // Draws one sample again, with the same numbers as in a render, and tells how it came about (path_record.h). False
  // when the algorithm has no samples that can be drawn alone.
  virtual bool replay(const SampleId&, PathRecord&) const { return false; }
};

}  // namespace etd
