#include "verify/scene/sample_peaks.h"

#include <cmath>

#include "accel/spawn.h"
#include "core/hash.h"
#include "materials/surface_scatter.h"

namespace etd {

namespace {

constexpr int kPaths = 512, kDepth = 3, kLightSamples = 16;
// Later events of a path multiply what one can bring: refraction compresses radiance by up to eta^2, and what a few
// paths met is not the most there is.
constexpr double kMargin = 4.0;

// The brightest emission, and the most that a sampled light can bring to a surface that reflects 1 to all sides.
void look_at_lights(const Scene& scene, const SurfacePoint& point, const ShadingContext& context, HashStream& rng,
                    double& emission, double& arriving) {
  const LightReceiver receiver(point, context.time);
  for (int i = 0; i < kLightSamples; ++i) {
    const auto choice = scene.light_sampler.sample(static_cast<double>(rng.next_float()), &receiver);
    if (!choice) return;
    const float x = rng.next_float(), y = rng.next_float();
    const auto s = scene.lights[choice->light].sample_li(point.p, {x, y}, context);
    if (!s) continue;
    const double radiance = max_value(s->radiance);
    if (!s->is_delta) emission = std::max(emission, radiance);
    arriving = std::max(arriving, radiance / (static_cast<double>(s->pdf) * static_cast<double>(choice->probability)));
  }
}

}  // namespace

SamplePeaks find_sample_peaks(const Scene& scene, int width, int height) {
  double emission = 0, arriving = 0, closure = 0;
  HashStream rng(1);
  for (int path = 0; path < kPaths; ++path) {
    CameraSample at;
    at.film.x = rng.next_float() * static_cast<float>(width);
    at.film.y = rng.next_float() * static_cast<float>(height);
    at.lens.x = rng.next_float(), at.lens.y = rng.next_float();
    at.time = rng.next_float();
    Ray ray = scene.camera.generate_ray(at);
    const ShadingContext context{ray.time};
    for (int depth = 0; depth < kDepth; ++depth) {
      Hit hit;
      if (!scene.intersect(ray, hit)) break;
      const SurfaceHit surface = scene.surface(hit);
      look_at_lights(scene, surface.point, context, rng, emission, arriving);
      const Shading shading = scene.shade(surface, context, rng);
      const SurfaceScatter scatter(shading.closure(), shading.frame, surface.point.ng);
      const float x = rng.next_float(), y = rng.next_float(), z = rng.next_float();
      const auto s = scatter.sample(-ray.d, {x, y, z}, TransportMode::kRadiance, rng);
      if (!s) break;
      if (!s->is_delta())
        closure = std::max(closure, static_cast<double>(max_value(s->weight)) * static_cast<double>(s->pdf));
      ray = spawn_ray(surface.point, s->wi, ray);
    }
  }
  return {kMargin * emission, kMargin * std::max(emission, arriving * closure)};
}

double chance_of_low_mean(double mean, double expected, double n, double peak) {
  if (!(expected > mean)) return 1.0;
  if (!(peak > 0.0)) return 0.0;
  return std::exp(-n * (expected - mean) * (expected - mean) / (2.0 * expected * std::max(peak, expected)));
}

}  // namespace etd
