#include "integrators/light.h"

#include <fmt/format.h>

#include <algorithm>

#include "accel/spawn.h"
#include "integrators/light_path.h"

namespace etd {

const ModelDecl& LightIntegrator::decl() {
  static const ModelDecl d =
      with_params({Family::kIntegrator,
                   "light",
                   "Light tracing: paths start at the lights, and each of their vertices is joined to the camera.",
                   {}},
                  {transport_params(TransportSettings().roulette_depth), {paths_from_lights_param()}});
  return d;
}

std::unique_ptr<Integrator> LightIntegrator::create(const ParamReader& p, const Scene& scene,
                                                    const IntegratorContext& context) {
  LightSettings s{transport_settings(p)};
  s.from_camera = leaves_out_what_the_camera_misses(p);
  return std::make_unique<LightIntegrator>(scene, s, context);
}

std::vector<Variant> LightIntegrator::variants(const Scene&, int) {
  return {{.name = "light", .set = {{"paths", "from_camera"}}, .image_of_path = {{"paths", "from_lights"}}}};
}

LightIntegrator::LightIntegrator(const Scene& scene, const LightSettings& settings, const IntegratorContext& context)
    : scene_(scene),
      settings_(settings),
      context_(context),
      camera_splat_(scene, context.width, context.height),
      lights_(scene.lights, light_sampler_of(scene, settings), scene.emission_disks) {}

std::string LightIntegrator::bias() const {
  std::string bias = kUnseenByLightPaths;
  if (settings_.indirect)
    bias += fmt::format("; light after more than {} scattering events is left out", settings_.max_depth);
  if (settings_.from_camera) bias += fmt::format("; {}", kUnseenByCameraPaths);
  return bias;
}

namespace {

constexpr uint64_t kPathsPerItem = 4096;

// Whether nothing is between the point and the camera. `ray`: that of the path at the point.
bool sees(const Scene& scene, const SurfacePoint& point, const CameraConnection& c, const Ray& ray, RayCounts& rays) {
  ++rays.shadow;
  return !scene.occluded(shadow_ray(point, point.p + c.wi * c.distance, ray));
}

}  // namespace

size_t LightIntegrator::work_items(const Pass& pass, uint32_t) const {
  const uint64_t paths = (pass.end - pass.begin) * paths_per_sample();
  return static_cast<size_t>((paths + kPathsPerItem - 1) / kPathsPerItem);
}

void LightIntegrator::render(const Pass& pass, uint32_t, size_t item, Sink& sink) {
  const uint64_t end_of_pass = pass.end * paths_per_sample();
  const uint64_t begin = pass.begin * paths_per_sample() + item * kPathsPerItem;
  const uint64_t end = std::min(begin + kPathsPerItem, end_of_pass);
  RayCounts rays;
  for (uint64_t path = begin; path < end; ++path) rays += trace(path, pass.first_replicate, sink);
  sink.count(rays);
  sink.count_light_paths(end - begin);
}

RayCounts LightIntegrator::trace(uint64_t path, uint32_t replicate, Sink& sink) const {
  RayCounts rays;
  // All paths of a replicate are points of one sequence, so that they are well distributed together.
  Sampler sampler(context_.sampler, context_.seed);
  sampler.start(path >> 32, replicate, static_cast<uint32_t>(path));
  const auto number = static_cast<uint32_t>(path / paths_per_sample()) * context_.replicates + replicate;
  const auto join = [&](const SurfacePoint& point, float time) {
    return scene_.camera.sample_wi(point.p, sampler.get_2d(), time, camera_splat_.margin());
  };
  const auto splat = [&](const SurfacePoint& point, const CameraConnection& c, const Ray& ray, int depth,
                         const Spectrum& light) {
    if (!(depth == 0 ? settings_.emission : depth == 1 ? settings_.direct : settings_.indirect)) return;
    if (!is_black(light) && sees(scene_, point, c, ray, rays))
      camera_splat_.add(sink, c.importance.film, depth, light, number);
  };

  // The light itself, as the camera sees it.
  const auto at_light = [&](const LightPathStart& s) {
    if (!s.has_surface) return;
    const SurfacePoint& point = s.emission.on_light;
    const auto c = join(point, s.context.time);
    if (!c) return;
    const Spectrum radiance = s.light.emitted(&point, c->wi, s.context);
    const float geometry = std::abs(dot(point.ng, c->wi)) * c->weight;
    splat(point, *c, s.emission.ray, 0, radiance * (geometry * s.alpha / (s.probability * s.emission.pdf_position)));
  };
  // Light that goes straight to the camera.
  const auto at_vertex = [&](const LightPathVertex& v) {
    if (!v.scatter.bsdf().has_smooth_lobe()) return true;
    sampler.set_dimension(v.dimension);
    if (const auto c = join(v.surface.point, v.ray.time))
      splat(v.surface.point, *c, v.ray, v.depth,
            v.flux * v.scatter.eval_cos(v.wo(), c->wi, TransportMode::kImportance, v.rng) * c->weight);
    return true;
  };
  follow_light_path(scene_, lights_, {settings_.max_depth, settings_.roulette_depth, settings_.from_camera}, sampler,
                    rays, at_light, at_vertex);
  return rays;
}

}  // namespace etd
