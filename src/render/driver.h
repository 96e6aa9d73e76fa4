// Runs an integrator: passes over the samples, work items of a pass on all threads, and between passes whatever wants
// to know how far the image is. Which samples make up a pass depends on sample indices alone, and which pixel's sums
// are added when depends on passes alone, so that neither threads nor an observer can change a bit of the image.
#pragma once

#include <atomic>
#include <vector>

#include "film/film.h"
#include "integrators/integrator.h"

namespace etd {

struct DriverSettings {
  uint32_t spp = 16;  // a multiple of the film's replicates
  int threads = 0;    // 0: all cores
};

struct RenderProgress {
  uint32_t spp = 0;         // to be taken
  double spp_done = 0;      // taken, with the share of the running pass
  uint64_t rays = 0;        // traced so far
  double seconds = 0;       // since the render began
  double error = HUGE_VAL;  // estimated_error() after the last complete pass
};

// Told what happens. on_progress() is called by any thread, several at a time; the other one by the driver's.
class RenderObserver {
 public:
  virtual ~RenderObserver() = default;
  virtual void on_progress(const RenderProgress&) {}
  virtual void on_pass_end(const RenderProgress&) {}
};

struct RenderResult {
  RayCounts rays;
  uint32_t spp = 0;          // samples that every pixel has
  bool interrupted = false;  // stopped before the last sample
  double seconds = 0;
  double error = HUGE_VAL;  // estimated_error() of the film
};

// The passes for n samples per replicate: [0,1), [1,2), [2,4), [4,8), [8,16), then steps of 16.
std::vector<Pass> pass_schedule(uint32_t samples_per_replicate);

// The relative standard error of the image as one number, from luminances Y of mean Ybar:
//   sqrt(mean over pixels of se^2 / (Y^2 + 0.01 Ybar^2)).
// +inf where some pixel has fewer than two samples. `threads` as in DriverSettings.
double estimated_error(const Film& film, int threads = 0);

// Renders into an empty film. When `stop` becomes true, running items finish, the others are left out, and the film
// holds a valid estimate of unequal sample counts. Exceptions of the integrator pass through.
RenderResult render(Integrator& integrator, Film& film, const DriverSettings& settings, RenderObserver& observer,
                    const std::atomic<bool>* stop = nullptr);

}  // namespace etd
