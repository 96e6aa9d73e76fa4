// Light tracing, also called particle tracing (Arvo 1986; Dutré, Lafortune and Willems 1993): paths start at lights,
// and each of their vertices is joined to the camera.
#pragma once

#include "integrators/camera_splat.h"
#include "integrators/integrator.h"
#include "integrators/transport_params.h"
#include "integrators/variant.h"
#include "light_sampling/emission_sampler.h"
#include "params/declaration.h"
#include "scene/scene.h"

namespace etd {

// What paths from lights never bring to the camera, which no join hits: for the metadata of an image.
inline constexpr const char* kUnseenByLightPaths =
    "infinite lights seen directly, and what is seen through or in smooth surfaces, are left out";

struct LightSettings : TransportSettings {
  bool from_camera = false;  // LightPathSettings::from_camera
};

class LightIntegrator : public Integrator {
 public:
  static constexpr IntegratorTraits kTraits{
      .replayable = false, .splats = true, .correlated_pixels = true, .features = false};
  static const ModelDecl& decl();
  static std::unique_ptr<Integrator> create(const ParamReader& p, const Scene& scene, const IntegratorContext& context);
  static std::vector<Variant> variants(const Scene& scene, int max_depth);

  LightIntegrator(const Scene& scene, const LightSettings& settings, const IntegratorContext& context);

  IntegratorTraits traits() const override { return kTraits; }
  std::string bias() const override;
  size_t work_items(const Pass& pass, uint32_t phase) const override;
  void render(const Pass& pass, uint32_t phase, size_t item, Sink& sink) override;

 private:
  // Paths of each replicate that make one sample of each pixel.
  uint64_t paths_per_sample() const {
    return static_cast<uint64_t>(context_.width) * static_cast<uint64_t>(context_.height);
  }
  // The path of this number in its replicate. Returns the rays that it took.
  RayCounts trace(uint64_t path, uint32_t replicate, Sink& sink) const;

  const Scene& scene_;
  LightSettings settings_;
  IntegratorContext context_;
  CameraSplat camera_splat_;
  EmissionSampler lights_;
};

}  // namespace etd
