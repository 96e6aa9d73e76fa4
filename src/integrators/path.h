// Path tracing (Kajiya 1986): from the camera, one random path at a time.
#pragma once

#include "core/mis.h"
#include "integrators/guiding/training.h"
#include "integrators/pixel_integrator.h"
#include "integrators/transport_params.h"
#include "integrators/variant.h"
#include "params/declaration.h"
#include "scene/scene.h"

namespace etd {

// How light is found; three estimators of the same image.
enum class PathMode : uint8_t {
  kNaive,      // only by running into emitters
  kNextEvent,  // by sampling a light at every vertex; emitters that are run into count after delta lobes alone
  kMis,        // both, weighted (mis.h)
};

struct PathSettings : TransportSettings {
  PathMode mode = PathMode::kMis;
  MisHeuristic heuristic = MisHeuristic::kPower;
  bool bent_normals = false;  // materials/bent_normal.h
  bool guiding = false;       // guiding/
  uint64_t guiding_paths = 0;
  bool from_lights = false;  // only what paths from lights can bring (light.h)
};

class PathIntegrator : public PixelIntegrator {
 public:
  static constexpr IntegratorTraits kTraits{};
  static const ModelDecl& decl();
  static PathSettings settings(const ParamReader& params);
  static std::unique_ptr<Integrator> create(const ParamReader& p, const Scene& scene, const IntegratorContext& context);
  static std::vector<Variant> variants(const Scene& scene, int max_depth);

  PathIntegrator(const Scene& scene, const PathSettings& settings, const IntegratorContext& context);

  IntegratorTraits traits() const override { return kTraits; }
  std::string bias() const override;
  uint64_t bytes() const override { return guide_ ? guide_->most_bytes() : 0; }
  // Guiding puts its training before the first samples.
  uint32_t phases(const Pass& pass) const override;
  void begin(const Pass& pass, uint32_t phase) override;
  size_t work_items(const Pass& pass, uint32_t phase) const override;
  void render(const Pass& pass, uint32_t phase, size_t item, Sink& sink) override;

 protected:
  PixelSample sample_pixel(int x, int y, Sampler& sampler) const override;
  PixelSample record_pixel(int x, int y, Sampler& sampler, PathRecord& record) const override;

 private:
  bool in_training(uint32_t phase) const;
  template <class Recorder>
  PixelSample trace(int x, int y, Sampler& sampler, Recorder recorder) const;

  const Scene& scene_;
  PathSettings settings_;
  LightSampler lights_;
  std::unique_ptr<GuideTraining> guide_;  // nullptr: directions are the closures'
};

}  // namespace etd
