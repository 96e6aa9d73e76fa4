#include "integrators/sppm.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "integrators/camera_path.h"
#include "integrators/light_path.h"
#include "integrators/next_event.h"
#include "integrators/path_record.h"

namespace etd {

namespace {

constexpr int kLongestPath = 1 << 15;  // so many scattering events a photon can count

}  // namespace

const ModelDecl& SppmIntegrator::decl() {
  static const ModelDecl d = with_params(
      {Family::kIntegrator,
       "sppm",
       "Stochastic progressive photon mapping: light by photons that are gathered within a radius, which shrinks from "
       "iteration to iteration.",
       {}},
      {transport_params(kLongestPath),
       {{.name = "radius",
         .default_value = 0.0,
         .min = 0,
         .unit = "m",
         .doc =
             "Radius of the first iteration; 0: about as wide as a pixel, or so wide that some ten photons are found."},
        {.name = "radiusscale",
         .default_value = 1.0,
         .min = 0,
         .above_min = true,
         .doc = "Factor on the radius, with whose square the bias goes: two renders tell how large it is."},
        {.name = "photonsperiteration",
         .type = ParamType::kInteger,
         .default_value = -1,
         .min = -1,
         .max = 1 << 26,
         .doc = "Paths from lights in each iteration; -1: as many as the full image has pixels."},
        {.name = "directlight",
         .type = ParamType::kString,
         .default_value = std::string("sampled"),
         .choices = {"sampled", "photons"},
         .doc = "How direct light is found: by sampling lights, or by photons as all other light."},
        paths_from_lights_param()}});
  return d;
}

std::unique_ptr<Integrator> SppmIntegrator::create(const ParamReader& p, const Scene& scene,
                                                   const IntegratorContext& context) {
  SppmSettings s{transport_settings(p)};
  s.radius = p.number("radius");
  s.radius_scale = p.number("radiusscale");
  s.photons = static_cast<uint64_t>(std::max(0, p.integer("photonsperiteration")));
  s.direct_photons = p.string("directlight") == "photons";
  s.from_camera = leaves_out_what_the_camera_misses(p);
  return std::make_unique<SppmIntegrator>(scene, s, context);
}

std::vector<Variant> SppmIntegrator::variants(const Scene&, int) {
  const ParameterTexts half{{"radiusscale", "0.5"}};
  return {{.name = "sppm", .set = {{"paths", "from_camera"}}, .with_half_radius = half},
          {.name = "sppm, photons alone",
           .set = {{"paths", "from_camera"}, {"directlight", "photons"}},
           .with_half_radius = half}};
}

namespace {

constexpr double kAlpha =
    2.0 / 3.0;  // at which bias and noise fall at the same rate (Knaus and Zwicker 2011, section 4)
constexpr uint64_t kPhotonsPerItem = 4096;
// Streams of photons, which no pixel has.
constexpr uint64_t kPhotonStream = uint64_t{1} << 62;
enum Phase : uint32_t { kTrace, kBuild, kGather, kPhases };

// Sampler dimensions of a camera path's vertex.
constexpr uint32_t kVertexDimensions = 6;
enum VertexDimension : uint32_t { kLightChoice, kLightPoint, kScatter, kScatterLobe, kRoulette };

// About as wide as a pixel on what the camera sees, or so wide that some ten photons are found if they spread evenly
// over a sphere around it.
double first_radius(const Scene& scene, double pixels, double photons) {
  constexpr double kPhotonsWanted = 10, kPixelsWide = 1.5;
  const BoundingSphere& seen = scene.seen.radius > 0.0f ? scene.seen : scene.emission_disks.scene();
  const double size = seen.radius;
  return std::max(kPixelsWide * 2.0 * size / std::sqrt(pixels), size * std::sqrt(4.0 * kPhotonsWanted / photons));
}

}  // namespace

SppmIntegrator::SppmIntegrator(const Scene& scene, const SppmSettings& settings, const IntegratorContext& context)
    : scene_(scene),
      settings_(settings),
      context_(context),
      tiles_(context),
      lights_(light_sampler_of(scene, settings)) {
  const uint64_t pixels = static_cast<uint64_t>(context.width) * static_cast<uint64_t>(context.height);
  if (settings_.photons == 0) settings_.photons = pixels;
  if (!(settings_.radius > 0))
    settings_.radius = first_radius(scene, static_cast<double>(pixels), static_cast<double>(settings_.photons));
  settings_.radius *= settings_.radius_scale;
}

std::string SppmIntegrator::bias() const {
  return fmt::format(
             "photons are spread over {:.4g} m in the first and {:.4g} m in the last iteration, which falls to 0 as "
             "iterations^(-1/6); light after more than {} scattering events is left out",
             radius(0), radius(last_), settings_.max_depth) +
         (settings_.from_camera ? fmt::format("; {}", kUnseenByCameraPaths) : "");
}

double SppmIntegrator::radius(uint64_t i) const {
  // The product of (k + alpha) / (k + 1) for k = 1 ... i.
  const double n = static_cast<double>(i);
  const double log = std::lgamma(n + 1 + kAlpha) - std::lgamma(1 + kAlpha) - std::lgamma(n + 2) + std::lgamma(2.0);
  return settings_.radius * std::exp(0.5 * log);
}

uint32_t SppmIntegrator::phases(const Pass& pass) const {
  return (pass.end - pass.begin) * (pass.end_replicate - pass.first_replicate) * kPhases;
}

SppmIntegrator::Iteration SppmIntegrator::iteration(const Pass& pass, uint32_t phase) const {
  const uint32_t number = phase / kPhases, replicates = pass.end_replicate - pass.first_replicate;
  return {pass.first_replicate + number % replicates, pass.begin + number / replicates};
}

void SppmIntegrator::begin(const Pass& pass, uint32_t phase) {
  if (phase % kPhases == kTrace) {
    const Iteration i = iteration(pass, phase);
    const uint64_t number = uint64_t{i.index} * context_.replicates + i.replicate;
    last_ = std::max(last_, number);
    radius_ = static_cast<float>(radius(number));
    grid_.start(work_items(pass, phase), 2.0f * radius_);
  }
  if (phase % kPhases == kBuild) grid_.begin_build();
}

size_t SppmIntegrator::work_items(const Pass&, uint32_t phase) const {
  switch (phase % kPhases) {
    case kTrace:
      return static_cast<size_t>((settings_.photons + kPhotonsPerItem - 1) / kPhotonsPerItem);
    case kBuild:
      return PhotonGrid::kParts;
    default:
      return tiles_.count();
  }
}

void SppmIntegrator::render(const Pass& pass, uint32_t phase, size_t item, Sink& sink) {
  const Iteration i = iteration(pass, phase);
  switch (phase % kPhases) {
    case kTrace:
      return trace_photons(i, item, sink);
    case kBuild:
      return grid_.build(item);
    default:
      return gather_tile(i, item, sink);
  }
}

void SppmIntegrator::trace_photons(const Iteration& i, size_t item, Sink& sink) {
  const uint64_t begin = item * kPhotonsPerItem, end = std::min(begin + kPhotonsPerItem, settings_.photons);
  const LightPathSettings settings{settings_.max_depth, settings_.roulette_depth, settings_.from_camera};
  const bool any_kept = settings_.indirect || (settings_.direct && settings_.direct_photons);
  RayCounts rays;
  for (uint64_t k = begin; k < end && any_kept; ++k) {
    // All photons of a replicate are points of one sequence.
    const uint64_t number = i.index * settings_.photons + k;
    Sampler sampler(context_.sampler, context_.seed);
    sampler.start(kPhotonStream + (number >> 32), i.replicate, static_cast<uint32_t>(number));
    const auto at_vertex = [&](const LightPathVertex& v) {
      const float cosine = std::abs(dot(v.wo(), v.point.ng));
      if (!v.scatter.bsdf().has_smooth_lobe() || (v.depth == 1 && !settings_.direct_photons) || !(cosine > 0.0f))
        return true;
      const Spectrum flux = v.flux * (1.0f / cosine);
      if (is_finite(flux) && !is_black(flux))
        grid_.add(item,
                  {v.point.p, Photon::encode(v.wo()), static_cast<uint16_t>(v.depth - 1), {flux[0], flux[1], flux[2]}});
      return true;
    };
    follow_light_path(
        scene_, lights_, settings, sampler, rays, [](const LightPathStart&) {}, at_vertex);
  }
  grid_.finish_item(item);
  sink.count(rays);
}

void SppmIntegrator::gather_tile(const Iteration& i, size_t item, Sink& sink) const {
  const PixelBounds tile = tiles_.tile(item);
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x) {
      Sampler sampler(context_.sampler, context_.seed);
      sampler.start(static_cast<uint64_t>(y) * static_cast<uint64_t>(context_.width) + static_cast<uint64_t>(x),
                    i.replicate, i.index);
      Sink::Pixel(sink, x, y).add(i.replicate, i.index, gather(x, y, sampler));
    }
}

// A path from the camera, on by way of deltas alone: wherever there is anything else, light is gathered.
PixelSample SppmIntegrator::gather(int x, int y, Sampler& sampler) const {
  PixelSample out;
  const CameraPathStart start = start_camera_path(scene_, x, y, sampler, out);
  Ray ray = start.ray;
  const ShadingContext context{ray.time};
  const NextEvent how{lights_};
  NoRecorder recorder;
  PathFeatures features;
  Spectrum beta(1.0f);
  float eta_scale = 1.0f;  // what refraction has taken off beta, given back for roulette alone
  const auto add = [&](int depth, const Spectrum& radiance) {
    if (!(depth == 0 ? settings_.emission : depth == 1 ? settings_.direct : settings_.indirect)) return;
    (depth == 0 ? out.emission : depth == 1 ? out.direct : out.indirect) += beta * radiance;
  };

  for (int depth = 0;; ++depth) {
    Hit hit;
    ++(depth == 0 ? out.rays.camera : out.rays.indirect);
    if (!scene_.intersect(ray, hit)) {
      for (const uint32_t light : scene_.infinite_lights)
        add(depth, scene_.lights[light].emitted(nullptr, -ray.d, context, ray.o));
      break;
    }
    const SurfaceHit surface = scene_.surface(hit);
    const SurfacePoint& point = surface.point;
    const Vec3 wo = -ray.d;
    features.meet(scene_, depth, hit, out);
    if (surface.light != kNoId) add(depth, scene_.lights[surface.light].emitted(&point, wo, context, ray.o));

    const uint32_t dimension = kCameraDimensions + static_cast<uint32_t>(depth) * kVertexDimensions;
    HashStream rng(sampler.key(dimension));
    const Shading shading = scene_.shade(surface, context, rng);
    const SurfaceScatter scatter(shading.closure, shading.frame, point.ng);
    const Bsdf& bsdf = scatter.bsdf();
    features.shade(point, scatter, wo, out);
    if (depth == settings_.max_depth) break;

    if (bsdf.has_smooth_lobe()) {
      if (!settings_.direct_photons) {
        sampler.set_dimension(dimension + kLightChoice);
        add(depth + 1, next_event(scene_, how, {point, scatter, ray, context}, sampler, rng, out.rays, recorder));
      }
      Spectrum direct;
      const Spectrum indirect = photon_light(point, scatter, wo, depth, rng, direct);
      add(depth + 1, direct);
      add(2, indirect);
    }
    if ((bsdf.lobes() & kDelta) == 0) break;

    // By way of a mirror or through glass.
    sampler.set_dimension(dimension + kScatter);
    const auto s = scatter.sample(wo, sampler.get_3d(), TransportMode::kRadiance, rng);
    if (!s || !s->is_delta()) break;
    beta *= s->weight;
    if (s->is_transmission()) eta_scale *= sqr(s->eta);
    ray = spawn_ray(point, s->wi, ray);
    const float survival = max_value(beta) * eta_scale;
    if (depth + 1 >= settings_.roulette_depth && survival < 1.0f) {
      sampler.set_dimension(dimension + kRoulette);
      if (!(sampler.get_1d() < survival)) break;
      beta *= 1.0f / survival;
    }
  }
  return out;
}

// The radiance that photons near the point bring along wo: their flux over the disk, times f |light . ns| / |light .
// ng|, of which the photon carries the divisor. `depth`: scattering events between the point and the camera. Light
// whose only event is at the point comes in `direct`.
Spectrum SppmIntegrator::photon_light(const SurfacePoint& point, const SurfaceScatter& scatter, Vec3 wo, int depth,
                                      HashStream& rng, Spectrum& direct) const {
  Spectrum indirect;
  grid_.for_photons_near(point.p, radius_, [&](const Photon& photon) {
    if (depth + photon.events + 1 > settings_.max_depth) return;
    const Spectrum f = scatter.eval_cos(wo, photon.direction(), TransportMode::kRadiance, rng);
    if (is_black(f)) return;
    (photon.events == 0 ? direct : indirect) += f * Spectrum::rgb(photon.flux[0], photon.flux[1], photon.flux[2]);
  });
  const double disk = static_cast<double>(kPi) * sqr(static_cast<double>(radius_));
  const float scale = static_cast<float>(1.0 / (disk * static_cast<double>(settings_.photons)));
  direct *= scale;
  return indirect * scale;
}

}  // namespace etd
