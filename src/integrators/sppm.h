// Stochastic progressive photon mapping (Hachisuka and Jensen 2009) in the form of Knaus and Zwicker 2011: each
// iteration is a photon map of its own with a radius that depends on its number alone, and an estimate of its own.
// Their mean converges to the image, because the radii fall so slowly that the noise goes away as well.
#pragma once

#include "integrators/light_path.h"
#include "integrators/photon_grid.h"
#include "integrators/photon_radius.h"
#include "integrators/pixel_tiles.h"
#include "integrators/transport_params.h"
#include "integrators/variant.h"
#include "materials/surface_scatter.h"
#include "params/declaration.h"
#include "scene/scene.h"

namespace etd {

struct SppmSettings : TransportSettings {
  double radius = 0;                          // of the first iteration, in metres; 0: found from the scene
  double radius_scale = 1;                    // on that
  uint64_t photons = 0;                       // paths from lights in each iteration; 0: as many as pixels
  uint64_t photon_bytes = uint64_t{2} << 30;  // of memory for the photons of an iteration; fewer paths if need be
  float near_delta = 0;         // closures whose lobes are all narrower than this alpha are passed as mirrors are
  bool direct_photons = false;  // photons bring direct light too
  bool from_camera = false;     // LightPathSettings::from_camera
};

class SppmIntegrator : public Integrator {
 public:
  static constexpr IntegratorTraits kTraits{.replayable = false, .correlated_pixels = true, .consistent = true};
  static const ModelDecl& decl();
  static std::unique_ptr<Integrator> create(const ParamReader& p, const Scene& scene, const IntegratorContext& context);
  static std::vector<Variant> variants(const Scene& scene, int max_depth);

  SppmIntegrator(const Scene& scene, const SppmSettings& settings, const IntegratorContext& context);

  IntegratorTraits traits() const override { return kTraits; }
  std::string bias() const override;
  uint64_t bytes() const override;
  // Each iteration has three: photons leave the lights, the grid is made of them, pixels gather.
  uint32_t phases(const Pass& pass) const override;
  void begin(const Pass& pass, uint32_t phase) override;
  size_t work_items(const Pass& pass, uint32_t phase) const override;
  void render(const Pass& pass, uint32_t phase, size_t item, Sink& sink) override;

  // The radius of iteration i, counted from 0 over all replicates: r_i^2 = r_{i-1}^2 (i + alpha) / (i + 1) for i > 0.
  double radius(uint64_t iteration) const;

 private:
  struct Iteration {
    uint32_t replicate, index;
  };
  Iteration iteration(const Pass& pass, uint32_t phase) const;
  // Calls keep(photon) for what a path from the lights leaves.
  template <class F>
  void trace_path(Sampler& sampler, RayCounts& rays, F&& keep) const;
  // The photons of a few paths tell how many there will be, and how wide to search.
  std::vector<Point3> pilot_photons() const;
  std::vector<SeenPoint> pilot_points() const;
  void trace_photons(const Iteration& i, size_t item, Sink& sink);
  void gather_tile(const Iteration& i, size_t item, Sink& sink) const;
  PixelSample gather(int x, int y, Sampler& sampler) const;
  bool is_near_delta(const Bsdf& bsdf) const { return bsdf.widest_alpha() < settings_.near_delta; }
  Spectrum photon_light(const SurfacePoint& point, const SurfaceScatter& scatter, Vec3 wo, int depth, bool hidden,
                        HashStream& rng, Spectrum& direct) const;

  const Scene& scene_;
  SppmSettings settings_;
  IntegratorContext context_;
  PixelTiles tiles_;
  LightSampler lights_;         // for light sampling
  EmissionSampler emitters_;    // for photons
  uint32_t pilot_paths_ = 0;    // from lights, that were followed to know what comes
  double photons_of_path_ = 0;  // mean number that a path leaves
  uint64_t last_ = 0;           // the highest number of an iteration that has begun
  // Of the running iteration:
  PhotonGrid grid_;
  float radius_ = 0;
  float time_ = 0;  // in [0, 1), of the shutter's interval: photons and camera see what moves in one place
};

}  // namespace etd
