// Makes a guide of the photons that leave the lights, in two phases before the first samples of pixels.
#pragma once

#include "integrators/guiding/guide.h"
#include "integrators/integrator.h"
#include "light_sampling/emission_sampler.h"
#include "scene/scene.h"

namespace etd {

struct GuideSettings {
  uint64_t paths = 0;                 // from lights
  int max_depth = 0;                  // surfaces that each meets at most
  bool next_event_estimation = true;  // finds light that comes straight from its light
};

class GuideTraining {
 public:
  static constexpr uint32_t kPhases = 2;

  GuideTraining(const Scene& scene, const LightSampler& lights, const GuideSettings& settings,
                const IntegratorContext& context);

  // Work items of a phase may run at the same time, after its begin(); end() follows the last phase.
  void begin(uint32_t phase);
  size_t work_items(uint32_t phase) const;
  void run(uint32_t phase, size_t item);
  void end();
  // Does all of this on one thread, unless it has been done.
  void run_all();

  const Guide& guide() const { return guide_; }
  uint64_t most_bytes() const;

 private:
  void trace(size_t item);

  const Scene& scene_;
  GuideSettings settings_;
  IntegratorContext context_;
  EmissionSampler emitters_;
  Guide guide_;
};

}  // namespace etd
