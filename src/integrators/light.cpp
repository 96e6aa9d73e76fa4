#include "integrators/light.h"

#include <fmt/format.h>

#include <algorithm>

#include "accel/spawn.h"
#include "core/flush_to_zero.h"
#include "materials/surface_scatter.h"

namespace etd {

const ModelDecl& LightIntegrator::decl() {
  static const ModelDecl d{
      Family::kIntegrator,
      "light",
      "Light tracing: paths start at the lights, and each of their vertices is joined to the camera.",
      {{.name = "maxdepth",
        .type = ParamType::kInteger,
        .default_value = 5,
        .min = 0,
        .max = 1 << 20,
        .doc = "Scattering events of the longest path: 0 shows emitters, 1 direct light, 2 one bounce more."},
       {.name = "components",
        .type = ParamType::kString,
        .default_value = std::string("all"),
        .choices = {"all", "emission", "direct", "indirect"},
        .doc = "Which part of the light to render."},
       {.name = "roulettedepth",
        .type = ParamType::kInteger,
        .default_value = 2,
        .min = 1,
        .max = 1 << 20,
        .doc = "Scattering events after which Russian roulette may end a path; never changes the mean."},
       {.name = "lightsampler",
        .type = ParamType::kString,
        .default_value = std::string("power"),
        .choices = {"power", "uniform"},
        .doc = "How the light is chosen that a path starts at: by power, or all alike; never changes the mean."}}};
  return d;
}

std::unique_ptr<Integrator> LightIntegrator::create(const ParamReader& p, const Scene& scene,
                                                    const IntegratorContext& context) {
  LightSettings s;
  const std::string components = p.string("components");
  const bool all = components == "all";
  s.emission = all || components == "emission";
  s.direct = all || components == "direct";
  s.indirect = all || components == "indirect";
  s.max_depth = p.integer("maxdepth");
  // No path is longer than the deepest component that is kept.
  if (!s.indirect) s.max_depth = std::min(s.max_depth, s.direct ? 1 : 0);
  s.roulette_depth = p.integer("roulettedepth");
  s.light_choice = p.string("lightsampler") == "uniform" ? LightChoice::kUniform : LightChoice::kPower;
  return std::make_unique<LightIntegrator>(scene, s, context);
}

std::vector<Variant> LightIntegrator::variants(const Scene&, int) {
  return {{.name = "light", .image_of_path = {{"paths", "from_lights"}}}};
}

LightIntegrator::LightIntegrator(const Scene& scene, const LightSettings& settings, const IntegratorContext& context)
    : scene_(scene), settings_(settings), context_(context), camera_splat_(scene, context.width, context.height) {
  if (settings.light_choice == LightChoice::kUniform) uniform_.emplace(scene.lights, LightChoice::kUniform);
}

std::string LightIntegrator::bias() const {
  std::string bias = kUnseenByLightPaths;
  if (settings_.indirect)
    bias += fmt::format("; light after more than {} scattering events is left out", settings_.max_depth);
  return bias;
}

namespace {

constexpr uint64_t kPathsPerItem = 4096;

// Sampler dimensions: time, light and place, direction and the join of the light's own point, then a fixed block per
// vertex.
constexpr uint32_t kLightDimensions = 5, kVertexDimensions = 4;
enum VertexDimension : uint32_t { kLens, kScatter, kScatterLobe, kRoulette };

// What a ray met before its start when it comes from infinitely far away: the first thing of all. Looked for backwards,
// from surface to surface.
bool find_first(const Scene& scene, const Ray& ray, Hit& first, RayCounts& rays) {
  bool found = false;
  Ray back{ray.o, -ray.d, kInfinity, ray.time};
  for (Hit hit; ++rays.indirect, scene.intersect(back, hit); found = true) {
    first = hit;
    back = spawn_ray(scene.surface(hit).point, back.d, ray.time);
  }
  return found;
}

// Whether nothing is between the point and the camera.
bool sees(const Scene& scene, const SurfacePoint& point, const CameraConnection& c, float time, RayCounts& rays) {
  ++rays.shadow;
  return !scene.occluded(shadow_ray(point, point.p + c.wi * c.distance, time));
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
  const auto splat = [&](const CameraConnection& c, int depth, const Spectrum& light) {
    if (!(depth == 0 ? settings_.emission : depth == 1 ? settings_.direct : settings_.indirect)) return;
    camera_splat_.add(sink, c.importance.film, depth, light, number);
  };

  // A ray that leaves a light.
  const LightSampler& lights = uniform_ ? *uniform_ : scene_.light_sampler;
  const float time = scene_.camera.ray_time(scene_.moves ? sampler.get_1d() : 0.0f);
  const auto choice = lights.sample(sampler.get_choice());
  if (!choice) return rays;
  const Light& light = scene_.lights[choice->light];
  const Vec2 u_position = sampler.get_2d(), u_direction = sampler.get_2d();
  const auto emitted = light.sample_le(u_position, u_direction, scene_.emission_disks, time);
  if (!emitted) return rays;
  const bool has_surface = !light.is_infinite() && !light.is_delta();
  const float alpha = has_surface ? scene_.light_alpha(choice->light, emitted->on_light) : 1.0f;
  Spectrum beta = emitted->weight() * (alpha / choice->probability);  // flux along the ray, per path

  // The light itself, as the camera sees it.
  if (has_surface) {
    const SurfacePoint& point = emitted->on_light;
    if (const auto c = scene_.camera.sample_wi(point.p, sampler.get_2d(), time, camera_splat_.margin())) {
      const Spectrum radiance = light.emitted(&point, c->wi, {}, time);
      const float geometry = std::abs(dot(point.ng, c->wi)) * c->weight;
      const Spectrum seen = radiance * (geometry * alpha / (choice->probability * emitted->pdf_position));
      if (!is_black(seen) && sees(scene_, point, *c, time, rays)) splat(*c, 0, seen);
    }
  }

  Ray ray = emitted->ray;
  float throughput = 1.0f;  // of the path since it left the light
  for (int depth = 1; depth <= settings_.max_depth; ++depth) {
    // Find the next vertex.
    Hit hit;
    ++rays.indirect;
    const bool from_within = depth == 1 && emitted->starts_within;
    if (!(from_within && find_first(scene_, ray, hit, rays)) && !scene_.intersect(ray, hit)) break;
    const SurfaceHit surface = scene_.surface(hit);
    const SurfacePoint& point = surface.point;
    const Vec3 wo = -ray.d;
    const uint32_t dimension = kLightDimensions + static_cast<uint32_t>(depth - 1) * kVertexDimensions;
    HashStream rng(sampler.key(dimension));
    const Shading shading = scene_.shade(surface, rng);
    const SurfaceScatter scatter(shading.closure, shading.frame, point.ng);

    // Light that goes straight to the camera.
    if (!scatter.bsdf().is_delta_only()) {
      sampler.set_dimension(dimension + kLens);
      if (const auto c = scene_.camera.sample_wi(point.p, sampler.get_2d(), time, camera_splat_.margin())) {
        const Spectrum seen = beta * scatter.eval_cos(wo, c->wi, TransportMode::kImportance, rng) * c->weight;
        if (!is_black(seen) && sees(scene_, point, *c, time, rays)) splat(*c, depth, seen);
      }
    }
    if (depth == settings_.max_depth) break;

    // Light that goes elsewhere: continue in a sampled direction.
    sampler.set_dimension(dimension + kScatter);
    const auto s = scatter.sample(wo, sampler.get_3d(), TransportMode::kImportance, rng);
    if (!s) break;
    beta *= s->weight;
    throughput *= max_value(s->weight);
    ray = spawn_ray(point, s->wi, time);

    // Russian roulette on the share of the flux that is left.
    if (depth >= settings_.roulette_depth && throughput < 1.0f) {
      sampler.set_dimension(dimension + kRoulette);
      if (!(sampler.get_1d() < throughput)) break;
      beta *= 1.0f / throughput;
      throughput = 1.0f;
    }
  }
  return rays;
}

}  // namespace etd
