// A path that starts at a light, which light tracing and photon mapping share: how it is emitted, meets surfaces and
// scatters. What its vertices are good for is the caller's.
#pragma once

#include "accel/spawn.h"
#include "film/pixel_sample.h"
#include "light_sampling/emission_sampler.h"
#include "materials/surface_scatter.h"
#include "samplers/sampler.h"
#include "scene/scene.h"

namespace etd {

struct LightPathSettings {
  int max_depth = 5;               // vertices at most
  int roulette_depth = 2;          // vertices after which paths may be ended early
  bool from_camera = false;        // leaves out what no path from the camera finds (kUnseenByCameraPaths)
  std::optional<float> time = {};  // in [0, 1), of the shutter's interval; without one, each path draws its own
};

// What paths from the camera never find, because neither sampling a light nor meeting one does: for the metadata.
inline constexpr const char* kUnseenByCameraPaths =
    "light of points and single directions by way of smooth surfaces next to them is left out";

// How a path leaves its light.
struct LightPathStart {
  const Light& light;
  uint32_t index;     // of the light in the scene
  float probability;  // of choosing it
  float alpha;        // share of its surface that is there
  bool has_surface;   // `emission.on_light` is a point that rays can meet
  EmissionSample emission;
  ShadingContext context;  // of the whole path

  Spectrum flux() const { return emission.weight() * (alpha / probability); }
};

struct LightPathVertex {
  int depth;  // from 1: scattering events with that of the vertex
  const Hit& hit;
  const SurfaceHit& surface;
  const Shading& shading;
  const SurfaceScatter& scatter;
  const Ray& ray;  // that arrived
  const ShadingContext& context;
  Spectrum flux;  // that arrives, W, for each path
  bool hidden;    // no path from the camera that goes on from here finds this light: kUnseenByCameraPaths
  HashStream& rng;
  uint32_t dimension;  // of the sampler: one that the caller may use

  Vec3 wo() const { return -ray.d; }  // towards the light
};

// Sampler dimensions: time, light, place, direction and one for the caller's use of the light's own point, then a fixed
// block for each vertex, of which the first is the caller's.
inline constexpr uint32_t kLightPathDimensions = 5, kLightVertexDimensions = 4;

// What a ray met before its start when it comes from infinitely far away: the first thing of all. It is looked for
// backwards, from surface to surface.
inline bool find_first(const Scene& scene, const Ray& ray, Hit& first, RayCounts& rays) {
  bool found = false;
  Ray back{ray.o, -ray.d, kInfinity, ray.time, ray.medium};
  for (Hit hit; ++rays.indirect, scene.intersect(back, hit); found = true) {
    first = hit;
    back = spawn_ray(scene.surface(hit).point, back.d, back);
  }
  return found;
}

// Calls at_light(start) once the path has left its light, and at_vertex(vertex) where it meets surfaces; it goes on
// from there if that returns true. Neither is called when no light shines along the chosen ray.
template <class AtLight, class AtVertex>
void follow_light_path(const Scene& scene, const EmissionSampler& lights, const LightPathSettings& settings,
                       Sampler& sampler, RayCounts& rays, AtLight&& at_light, AtVertex&& at_vertex) {
  const float time = !scene.moves ? 0.0f : settings.time ? *settings.time : sampler.get_1d();
  const ShadingContext context{scene.camera.ray_time(time)};
  const auto choice = lights.sample(sampler.get_choice());
  if (!choice) return;
  const Light& light = scene.lights[choice->light];
  const Vec2 u_position = sampler.get_2d(), u_direction = sampler.get_2d();
  const auto emitted = light.sample_le(u_position, u_direction, scene.emission_disks, context);
  if (!emitted) return;
  const bool has_surface = !light.is_infinite() && !light.is_delta();
  const float alpha = has_surface ? scene.light_alpha(choice->light, emitted->on_light, context) : 1.0f;
  const LightPathStart start{light, choice->light, choice->probability, alpha, has_surface, *emitted, context};
  at_light(start);

  Spectrum flux = start.flux();
  Ray ray = emitted->ray;
  bool hidden = false;
  float throughput = 1.0f;  // what scattering has left of the flux since roulette was played last
  for (int depth = 1; depth <= settings.max_depth; ++depth) {
    Hit hit;
    ++rays.indirect;
    const bool from_within = depth == 1 && emitted->starts_within;
    if (!(from_within && find_first(scene, ray, hit, rays)) && !scene.intersect(ray, hit)) return;
    const SurfaceHit surface = scene.surface(hit);
    const uint32_t dimension = kLightPathDimensions + static_cast<uint32_t>(depth - 1) * kLightVertexDimensions;
    HashStream rng(sampler.key(dimension));
    const Shading shading = scene.shade(surface, context, rng);
    const SurfaceScatter scatter(shading.closure(), shading.frame, surface.point.ng);
    if (!at_vertex(LightPathVertex{depth, hit, surface, shading, scatter, ray, context, flux, hidden, rng, dimension}))
      return;
    if (depth == settings.max_depth) return;

    sampler.set_dimension(dimension + 1);
    const auto s = scatter.sample(-ray.d, sampler.get_3d(), TransportMode::kImportance, rng);
    if (!s) return;
    hidden = (depth == 1 ? light.is_delta() : hidden) && s->is_delta();
    if (settings.from_camera && hidden) return;
    flux *= s->weight;
    throughput *= max_value(s->weight);
    ray = spawn_ray(surface.point, s->wi, ray);

    // Russian roulette on the share of the flux that is left.
    if (depth >= settings.roulette_depth && throughput < 1.0f) {
      sampler.set_dimension(dimension + 3);
      if (!(sampler.get_1d() < throughput)) return;
      flux *= 1.0f / throughput;
      throughput = 1.0f;
    }
  }
}

}  // namespace etd
