// Runs an integrator: passes over the samples, work items of a pass on all threads, and between passes whatever wants
// to know how far the image is. Which samples make up a pass depends on sample indices alone, and which pixel's sums
// are added when depends on passes alone, so that neither threads nor an observer can change a bit of the image.
#pragma once

#include <atomic>

#include "film/film.h"
#include "integrators/integrator.h"
#include "render/estimated_error.h"
#include "render/schedule.h"

namespace etd {

struct DriverSettings {
  uint32_t spp = 16;          // at most; a multiple of the film's replicates
  int threads = 0;            // 0: all cores
  double seconds = HUGE_VAL;  // at most; the first pass is finished in any case
  double error = 0;           // stop when estimated_error() is no larger, where tests_error() has it tested; 0: never
};

struct RenderProgress {
  uint32_t spp = 0;         // to be taken at most
  double spp_done = 0;      // taken, with the share of the running pass
  uint64_t rays = 0;        // traced so far
  double seconds = 0;       // since the render began
  double error = HUGE_VAL;  // estimated_error() after the last complete pass
  double share = 0;         // of the whole render that is done, as far as can be told; 1 only at its end
};

// Told what happens. on_progress() and wants_film() are called by any thread, several at a time; the others by the
// driver's, while no item runs.
class RenderObserver {
 public:
  virtual ~RenderObserver() = default;
  virtual void on_progress(const RenderProgress&) {}
  virtual void on_pass_end(const RenderProgress&) {}
  // Asked after each item and each pass: true pauses the render, in the midst of a pass too, for a look at the film.
  virtual bool wants_film() const { return false; }
  virtual void on_film(const Film&) {}
};

struct RenderResult {
  RayCounts rays;
  InvalidSamples invalid;  // that were left out of the film
  uint32_t spp = 0;        // samples that every pixel has
  StoppedBy stopped_by = StoppedBy::kSamples;
  double empty = 0;          // share of the pixels that have no sample: a render may be stopped within its first pass
  bool unequal = false;      // some pixels have more samples than others: a pass was cut off
  uint32_t error_tests = 0;  // how often the error could have stopped it
  double seconds = 0;
  double first_pass_seconds = 0;  // after which every pixel has a sample, unless the render was stopped before
  double error = HUGE_VAL;        // estimated_error() of the film
};

// Renders into an empty film. When `stop` becomes true, or a pass that did not look too long turns out to be when the
// time is over, running items finish, the others are left out, and the film holds a valid estimate of unequal sample
// counts; so it does when memory runs out. Other exceptions of the integrator pass through.
RenderResult render(Integrator& integrator, Film& film, const DriverSettings& settings, RenderObserver& observer,
                    const std::atomic<bool>* stop = nullptr);
// The same with a schedule of the caller's; samples and error of the settings count for progress alone.
RenderResult render(Integrator& integrator, Film& film, const DriverSettings& settings, Schedule& schedule,
                    RenderObserver& observer, const std::atomic<bool>* stop = nullptr);

}  // namespace etd
