// Path tracing (Kajiya 1986): from the camera, one random path at a time.
#pragma once

#include "integrators/pixel_integrator.h"
#include "params/declaration.h"
#include "scene/scene.h"

namespace etd {

// How light is found; three estimators of the same image.
enum class PathMode : uint8_t {
  kNaive,      // only by running into emitters
  kNextEvent,  // by sampling a light at every vertex; emitters that are run into count after delta lobes alone
  kMis,        // both, weighted by the power heuristic (Veach 1997, section 9.2)
};

struct PathSettings {
  int max_depth = 5;  // scattering events of the longest path
  PathMode mode = PathMode::kMis;
  bool emission = true, direct = true, indirect = true;  // which components are kept
  int roulette_depth = 2;                                // first depth at which paths may be ended early
};

class PathIntegrator : public PixelIntegrator {
 public:
  static const ModelDecl& decl();
  static PathSettings settings(const ParamReader& params);

  PathIntegrator(const Scene& scene, const PathSettings& settings, const IntegratorContext& context)
      : PixelIntegrator(context), scene_(scene), settings_(settings) {}

  std::string bias() const override;

 protected:
  PixelSample sample_pixel(int x, int y, Sampler& sampler) const override;
  PixelSample record_pixel(int x, int y, Sampler& sampler, PathRecord& record) const override;

 private:
  template <class Recorder>
  PixelSample trace(int x, int y, Sampler& sampler, Recorder recorder) const;

  const Scene& scene_;
  PathSettings settings_;
};

}  // namespace etd
