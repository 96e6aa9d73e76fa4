#include "integrators/path.h"

#include <fmt/format.h>

#include <algorithm>

#include "accel/spawn.h"
#include "materials/surface_scatter.h"

namespace etd {

const ModelDecl& PathIntegrator::decl() {
  static const ModelDecl d{
      Family::kIntegrator,
      "path",
      "Path tracing from the camera with next-event estimation and multiple importance sampling.",
      {{.name = "maxdepth",
        .type = ParamType::kInteger,
        .default_value = 5,
        .min = 0,
        .max = 1 << 20,
        .doc = "Scattering events of the longest path: 0 shows emitters, 1 direct light, 2 one bounce more."},
       {.name = "mode",
        .type = ParamType::kString,
        .default_value = std::string("mis"),
        .choices = {"mis", "next_event", "naive"},
        .doc = "How light is found: by sampling lights and closures together, lights alone, or closures alone."},
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
        .doc = "Scattering events after which Russian roulette may end a path; never changes the mean."}}};
  return d;
}

PathSettings PathIntegrator::settings(const ParamReader& p) {
  PathSettings s;
  const std::string mode = p.string("mode"), components = p.string("components");
  s.mode = mode == "naive" ? PathMode::kNaive : mode == "next_event" ? PathMode::kNextEvent : PathMode::kMis;
  const bool all = components == "all";
  s.emission = all || components == "emission";
  s.direct = all || components == "direct";
  s.indirect = all || components == "indirect";
  s.max_depth = p.integer("maxdepth");
  // No path is longer than the deepest component that is kept.
  if (!s.indirect) s.max_depth = std::min(s.max_depth, s.direct ? 1 : 0);
  s.roulette_depth = p.integer("roulettedepth");
  return s;
}

std::string PathIntegrator::bias() const {
  const bool delta =
      std::any_of(scene_.lights.begin(), scene_.lights.end(), [](const Light& l) { return l.is_delta(); });
  std::string bias;
  if (settings_.mode == PathMode::kNaive && delta) bias = "lights that no ray meets are left out";
  if (settings_.indirect)
    bias += fmt::format("{}light after more than {} scattering events is left out", bias.empty() ? "" : "; ",
                        settings_.max_depth);
  return bias;
}

namespace {

// Sampler dimensions: two for the camera ray, then a fixed block per path vertex.
constexpr uint32_t kCameraDimensions = 4, kVertexDimensions = 6;
enum VertexDimension : uint32_t { kLightChoice, kLightPoint, kScatter, kScatterLobe, kRoulette };

// Power heuristic with exponent 2 for one sample of each technique (Veach 1997, eq. 9.13).
float mis_weight(float pdf, float other) {
  if (std::isinf(pdf)) return 1.0f;
  const float p2 = pdf * pdf, o2 = other * other;
  return p2 + o2 > 0.0f && std::isfinite(p2 + o2) ? p2 / (p2 + o2) : (pdf > other ? 1.0f : 0.0f);
}

// Under MIS scattering reaches every direction as well.
LightSampling light_sampling(PathMode mode) {
  return mode == PathMode::kMis ? LightSampling::kCompensated : LightSampling::kComplete;
}

struct Vertex {
  const SurfacePoint& point;
  const SurfaceScatter& scatter;
  Vec3 wo;
};

// Radiance that one sampled light sends along wo through the vertex, weighted against closure sampling under MIS.
Spectrum next_event(const Scene& scene, const Vertex& v, PathMode mode, Sampler& sampler, HashStream& rng, float time,
                    PixelSample& out) {
  const double u_light = sampler.get_choice();
  const Vec2 u_point = sampler.get_2d();
  const auto choice = scene.light_sampler.sample(u_light);
  if (!choice) return Spectrum();
  const Light& light = scene.lights[choice->light];
  const auto s = light.sample_li(v.point.p, u_point, light_sampling(mode));
  if (!s) return Spectrum();
  Spectrum f = v.scatter.eval_cos(v.wo, s->wi, TransportMode::kRadiance, rng);
  if (is_black(f)) return Spectrum();
  ++out.rays.shadow;
  const bool infinite = light.is_infinite();
  if (scene.occluded(infinite ? spawn_ray(v.point, s->wi, time) : shadow_ray(v.point, s->on_light, time)))
    return Spectrum();
  const float pdf = choice->probability * s->pdf;
  const bool both = mode == PathMode::kMis && !s->is_delta;
  const float weight = both ? mis_weight(pdf, v.scatter.pdf(v.wo, s->wi, TransportMode::kRadiance)) : 1.0f;
  return f * s->radiance * (weight / pdf * scene.light_alpha(choice->light, s->on_light));
}

}  // namespace

PixelSample PathIntegrator::sample_pixel(int x, int y, Sampler& sampler) const {
  PixelSample out;
  const FilterSample film = scene_.filter.sample(sampler.get_2d());
  const CameraSample at{{static_cast<float>(x) + 0.5f + film.offset.x, static_cast<float>(y) + 0.5f + film.offset.y},
                        sampler.get_2d(),
                        0.0f};
  Ray ray = scene_.camera.generate_ray(at);

  out.weight = film.weight;
  Spectrum beta(1.0f);          // throughput: the product of f cos / pdf so far
  float eta_scale = 1.0f;       // what refraction has taken off beta, given back for roulette alone
  float scatter_pdf = 0.0f;     // density of the last direction per solid angle
  bool only_scattering = true;  // the last direction could not have come from light sampling
  SurfacePoint last;            // the vertex it left
  bool features_pending = true;
  float path_length = 0.0f;

  const auto add = [&](int depth, const Spectrum& radiance) {
    if (depth == 0 && settings_.emission) out.emission += radiance;
    if (depth == 1 && settings_.direct) out.direct += radiance;
    if (depth >= 2 && settings_.indirect) out.indirect += radiance;
  };
  // Weight of emission that scattering found: light sampling could have found it with density pdf_light.
  const auto emission_weight = [&](uint32_t light, const SurfacePoint* on_light) {
    if (only_scattering || settings_.mode == PathMode::kNaive) return 1.0f;
    if (settings_.mode == PathMode::kNextEvent) return 0.0f;
    const float pdf = scene_.lights[light].pdf_li(last.p, ray.d, on_light, light_sampling(settings_.mode));
    return mis_weight(scatter_pdf, scene_.light_sampler.probability(light) * pdf);
  };

  for (int depth = 0;; ++depth) {
    // Find the next vertex.
    Hit hit;
    ++(depth == 0 ? out.rays.camera : out.rays.indirect);
    if (!scene_.intersect(ray, hit)) {
      for (uint32_t light : scene_.infinite_lights)
        add(depth, beta * scene_.lights[light].emitted(nullptr, -ray.d, ray.o) * emission_weight(light, nullptr));
      break;
    }
    const SurfaceHit surface = scene_.surface(hit);
    const SurfacePoint& point = surface.point;
    const Vec3 wo = -ray.d;
    path_length += hit.t;

    // Light that the vertex emits.
    if (surface.light != kNoId) {
      const Spectrum radiance = scene_.lights[surface.light].emitted(&point, wo);
      if (!is_black(radiance)) add(depth, beta * radiance * emission_weight(surface.light, &point));
    }

    const uint32_t dimension = kCameraDimensions + static_cast<uint32_t>(depth) * kVertexDimensions;
    HashStream rng(sampler.key(dimension));
    const Shading shading = scene_.shade(surface, rng);
    const Bsdf& bsdf = shading.closure;
    if (features_pending && !(bsdf.is_delta_only() && (bsdf.lobes() & kDelta))) {
      out.albedo = bsdf.albedo(shading.frame.to_local(wo));
      out.normal = face_forward(shading.frame.z, wo);
      out.position = point.p - Point3();
      out.depth = path_length;
      out.coverage = 1.0f;
      features_pending = false;
    }
    if (depth == settings_.max_depth) break;
    const SurfaceScatter scatter(bsdf, shading.frame, point.ng);

    // Light that arrives straight from a light.
    if (settings_.mode != PathMode::kNaive && !bsdf.is_delta_only()) {
      sampler.set_dimension(dimension + kLightChoice);
      add(depth + 1, beta * next_event(scene_, {point, scatter, wo}, settings_.mode, sampler, rng, ray.time, out));
    }

    // Light that arrives from elsewhere: continue in a sampled direction.
    sampler.set_dimension(dimension + kScatter);
    const auto s = scatter.sample(wo, sampler.get_3d(), TransportMode::kRadiance, rng);
    if (!s) break;
    beta *= s->weight;
    if (s->is_transmission()) eta_scale *= sqr(s->eta);
    scatter_pdf = s->pdf;
    only_scattering = s->is_delta();
    last = point;
    ray = spawn_ray(point, s->wi, ray.time);

    // Russian roulette on the throughput, as it is without the compression of radiance in glass.
    const float survival = max_value(beta) * eta_scale;
    if (depth + 1 >= settings_.roulette_depth && survival < 1.0f) {
      sampler.set_dimension(dimension + kRoulette);
      if (!(sampler.get_1d() < survival)) break;
      beta *= 1.0f / survival;
    }
  }
  return out;
}

}  // namespace etd
