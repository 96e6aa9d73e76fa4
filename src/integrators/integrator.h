// The interface between algorithms and the driver. An integrator knows the scene and how to draw samples, and nothing
// about films, files, threads or windows: it cuts each pass into phases and these into work items, which the driver
// runs in any order on any number of threads, and hands what it finds to a sink.
#pragma once

#include <string>

#include "film/sink.h"
#include "integrators/pass.h"
#include "samplers/sampler.h"

namespace etd {

// What an algorithm promises, and so what the driver, the image's metadata and verdicts on it may rely on.
struct IntegratorTraits {
  bool replayable = true;          // a sample of a pixel depends on its own numbers alone: replay() draws it again
  bool splats = false;             // light reaches pixels of any work item: replicates are rendered one after the other
  bool correlated_pixels = false;  // errors of pixels depend on each other: only replicates tell that of a region
  bool features = true;            // samples tell what the camera sees: albedo, normals, depth, alpha and ids
  bool consistent = false;         // biased after any number of passes, by an amount that falls to 0 with more of them
  bool may_be_cut = true;          // a pass that ends before all of its items have run leaves a valid estimate
};

// Splats and other correlated pixels have no error of their own without a spread of replicates.
inline constexpr uint32_t kCorrelatedReplicates = 8;

// What an integrator needs beside its own parameters.
struct IntegratorContext {
  SamplerKind sampler;
  uint64_t seed = 0;
  int width = 0, height = 0;  // of the full image: name the streams
  PixelBounds crop;
  int tile_size = 16;
  uint32_t replicates = 2;
};

struct PathRecord;

class Integrator {
 public:
  virtual ~Integrator() = default;
  virtual IntegratorTraits traits() const = 0;
  // What makes the image differ from the unbiased answer, for its metadata; empty when nothing does.
  virtual std::string bias() const { return {}; }
  // Bytes of memory that it takes at most while it renders, beside the film.
  virtual uint64_t bytes() const { return 0; }
  // A pass is a number of phases, one after the other. Each is a step on one thread, begin(), and then a set of work
  // items on all of them: photons and then what they bring to pixels, for example.
  virtual uint32_t phases(const Pass&) const { return 1; }
  virtual void begin(const Pass&, uint32_t /*phase*/) {}
  virtual size_t work_items(const Pass& pass, uint32_t phase) const = 0;
  // Items of a phase run at the same time, and never hand over samples of the same pixel.
  virtual void render(const Pass& pass, uint32_t phase, size_t item, Sink& sink) = 0;
  // Draws one sample again, with the same numbers as in a render, and tells how it came about (path_record.h). False
  // when the algorithm has no samples that can be drawn alone.
  virtual bool replay(const SampleId&, PathRecord&) const { return false; }
};

}  // namespace etd
