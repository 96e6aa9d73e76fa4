#include "integrators/sppm.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "integrators/camera_path.h"
#include "integrators/light_path.h"
#include "integrators/next_event.h"
#include "integrators/path_record.h"
#include "integrators/photon_radius.h"

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
      {transport_params(TransportSettings().roulette_depth, kLongestPath),
       {{.name = "radius",
         .default_value = 0.0,
         .min = 0,
         .unit = "m",
         .doc = "Radius of the first iteration; 0: so wide that about four photons are found where many are seen, half "
                "a pixel at least."},
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
        {.name = "photonmemory",
         .type = ParamType::kInteger,
         .default_value = 2048,
         .min = 1,
         .max = 1 << 20,
         .unit = "MiB",
         .doc = "Memory for the photons of an iteration; fewer paths start at lights where all would not fit."},
        {.name = "neardelta",
         .default_value = 0.05,
         .min = 0,
         .max = 1,
         .doc = "Paths from the camera pass surfaces by whose lobes are all narrower than this alpha, as by mirrors, "
                "and gather photons beyond; never changes what the image converges to."},
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
  s.photon_bytes = static_cast<uint64_t>(p.integer("photonmemory")) << 20;
  s.near_delta = static_cast<float>(p.number("neardelta"));
  s.direct_photons = p.string("directlight") == "photons";
  s.from_camera = leaves_out_what_the_camera_misses(p);
  return std::make_unique<SppmIntegrator>(scene, s, context);
}

std::vector<Variant> SppmIntegrator::variants(const Scene&, int) {
  // Wide radii, of little noise: the extrapolation takes their bias away.
  const ParameterTexts half{{"radiusscale", "1.25"}};
  return {{.name = "sppm", .set = {{"paths", "from_camera"}, {"radiusscale", "2.5"}}, .with_half_radius = half},
          {.name = "sppm, photons alone",
           .set = {{"paths", "from_camera"}, {"directlight", "photons"}, {"radiusscale", "2.5"}},
           .with_half_radius = half}};
}

namespace {

constexpr double kAlpha =
    2.0 / 3.0;  // at which bias and noise fall at the same rate (Knaus and Zwicker 2011, section 4)
constexpr uint64_t kPhotonsPerItem = 4096;
// Paths of the pilot: as many as of an iteration, between these.
constexpr uint64_t kFewestPilotPaths = 4096, kMostPilotPaths = 32768;
constexpr uint32_t kPilotSide = 32;
// Streams of photons, of the times of iterations, and of the paths that tell how many photons there will be: no pixel
// has them.
constexpr uint64_t kPhotonStream = uint64_t{1} << 62, kTimeStream = kPhotonStream - 1, kPilotStream = kTimeStream - 1;
enum Phase : uint32_t { kTrace, kBuild, kGather, kPhases };

// Sampler dimensions of a camera path's vertex.
constexpr uint32_t kVertexDimensions = 6;
enum VertexDimension : uint32_t { kLightChoice, kLightPoint, kScatter, kScatterLobe, kRoulette };

}  // namespace

SppmIntegrator::SppmIntegrator(const Scene& scene, const SppmSettings& settings, const IntegratorContext& context)
    : scene_(scene),
      settings_(settings),
      context_(context),
      tiles_(context),
      lights_(light_sampler_of(scene, settings)),
      emitters_(scene.lights, lights_, scene.emission_disks) {
  const uint64_t pixels = static_cast<uint64_t>(context.width) * static_cast<uint64_t>(context.height);
  if (settings_.photons == 0) settings_.photons = pixels;
  pilot_paths_ = static_cast<uint32_t>(std::clamp(settings_.photons, kFewestPilotPaths, kMostPilotPaths));
  const std::vector<Point3> pilot = pilot_photons();
  photons_of_path_ = static_cast<double>(pilot.size()) / pilot_paths_;
  const double bytes_of_path = std::max(photons_of_path_, 1.0 / pilot_paths_) * PhotonGrid::kBytesOfPhoton;
  const double most = std::max(1.0, static_cast<double>(settings_.photon_bytes) / bytes_of_path);
  if (static_cast<double>(settings_.photons) > most) settings_.photons = static_cast<uint64_t>(most);
  if (!(settings_.radius > 0))
    settings_.radius =
        first_photon_radius(pilot, pilot_points(), static_cast<double>(settings_.photons) / pilot_paths_);
  // A camera that sees nothing gathers nothing.
  if (!(settings_.radius > 0)) settings_.radius = static_cast<double>(scene.emission_disks.scene().radius);
  settings_.radius *= settings_.radius_scale;
}

std::string SppmIntegrator::bias() const {
  return fmt::format(
             "the photons of {} paths from lights are spread over {:.4g} m in the first and {:.4g} m in the last "
             "iteration, which falls to 0 as iterations^(-1/6); light after more than {} scattering events is left out",
             settings_.photons, radius(0), radius(last_), settings_.max_depth) +
         (settings_.from_camera ? fmt::format("; {}", kUnseenByCameraPaths) : "");
}

uint64_t SppmIntegrator::bytes() const {
  return static_cast<uint64_t>(photons_of_path_ * static_cast<double>(settings_.photons) * PhotonGrid::kBytesOfPhoton);
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
    Sampler times(context_.sampler, context_.seed);
    times.start(kTimeStream, i.replicate, i.index);
    time_ = times.get_1d();
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

template <class F>
void SppmIntegrator::trace_path(Sampler& sampler, RayCounts& rays, F&& keep) const {
  const auto at_vertex = [&](const LightPathVertex& v) {
    if (v.depth == 1 && !settings_.direct_photons) return true;
    // Whoever gathers at a mixture may find another of its materials there.
    const bool mixed = v.shading.material != v.surface.material;
    const Bsdf& bsdf = v.scatter.bsdf();
    if (!mixed && !(bsdf.has_smooth_lobe() && (v.hidden || !is_near_delta(bsdf)))) return true;
    const SurfacePoint& point = v.surface.point;
    const float cosine = std::abs(dot(v.wo(), point.ng));
    if (!(cosine > 0.0f)) return true;
    // Where a share of the surface is missing, so is that of the photons; but who gathers stands on what is there.
    const Spectrum flux = v.flux * (1.0f / (cosine * std::min(scene_.alpha(v.hit, point, v.context), 1.0f)));
    if (is_finite(flux) && !is_black(flux))
      keep(Photon{
          point.p, Photon::encode(v.wo()), static_cast<uint16_t>(v.depth - 1), v.hidden, {flux[0], flux[1], flux[2]}});
    return true;
  };
  const LightPathSettings settings{settings_.max_depth, settings_.roulette_depth, settings_.from_camera, time_};
  follow_light_path(
      scene_, emitters_, settings, sampler, rays, [](const LightPathStart&) {}, at_vertex);
}

// The pilot is the same for all seeds, so that radii are.
std::vector<Point3> SppmIntegrator::pilot_photons() const {
  std::vector<Point3> photons;
  RayCounts rays;
  for (uint32_t k = 0; k < pilot_paths_; ++k) {
    Sampler sampler({}, 0);
    sampler.start(kPilotStream, 0, k);
    trace_path(sampler, rays, [&](const Photon& photon) { photons.push_back(photon.p); });
  }
  return photons;
}

// The first place on a path through each of a grid of points of the film where photons are gathered.
std::vector<SeenPoint> SppmIntegrator::pilot_points() const {
  std::vector<SeenPoint> seen;
  for (uint32_t k = 0; k < kPilotSide * kPilotSide; ++k) {
    Sampler sampler({}, 0);
    sampler.start(kPilotStream, 1, k);
    HashStream rng(sampler.key(0));
    const auto on_film = [](uint32_t i, int pixels) {
      return (static_cast<float>(i) + 0.5f) / kPilotSide * static_cast<float>(pixels);
    };
    CameraSample at{
        {on_film(k % kPilotSide, context_.width), on_film(k / kPilotSide, context_.height)}, {0.5f, 0.5f}, 0.5f};
    Ray ray = scene_.camera.generate_ray(at);
    const Ray first = ray;
    at.film = {at.film.x + 1, at.film.y + 1};
    const Ray next = scene_.camera.generate_ray(at);
    double length = 0;
    Hit hit;
    for (int depth = 0; depth < settings_.max_depth && scene_.intersect(ray, hit); ++depth) {
      length += static_cast<double>(hit.t);
      const SurfaceHit surface = scene_.surface(hit);
      const Shading shading = scene_.shade(surface, {ray.time}, rng);
      const SurfaceScatter scatter(shading.closure(), shading.frame, surface.point.ng);
      if (scatter.bsdf().has_smooth_lobe() && !is_near_delta(scatter.bsdf())) {
        // As if the path were straight. The diagonal of a pixel is sqrt(2) wide.
        const Vec3d apart = to_double(next.o - first.o) + length * to_double(next.d - first.d);
        seen.push_back({surface.point.p,
                        etd::length(apart - dot(apart, to_double(first.d)) * to_double(first.d)) / std::sqrt(2.0)});
        break;
      }
      const auto s = scatter.sample(-ray.d, sampler.get_3d(), TransportMode::kRadiance, rng);
      if (!s) break;
      ray = spawn_ray(surface.point, s->wi, ray);
    }
  }
  return seen;
}

void SppmIntegrator::trace_photons(const Iteration& i, size_t item, Sink& sink) {
  const uint64_t begin = item * kPhotonsPerItem, end = std::min(begin + kPhotonsPerItem, settings_.photons);
  const bool any_kept = settings_.indirect || (settings_.direct && settings_.direct_photons);
  RayCounts rays;
  for (uint64_t k = begin; k < end && any_kept; ++k) {
    // All photons of a replicate are points of one sequence.
    const uint64_t number = i.index * settings_.photons + k;
    Sampler sampler(context_.sampler, context_.seed);
    sampler.start(kPhotonStream + (number >> 32), i.replicate, static_cast<uint32_t>(number));
    trace_path(sampler, rays, [&](const Photon& photon) { grid_.add(item, photon); });
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

// A path from the camera, on by way of deltas and of what is nearly one: wherever there is anything else, light is
// gathered.
PixelSample SppmIntegrator::gather(int x, int y, Sampler& sampler) const {
  PixelSample out;
  const CameraPathStart start = start_camera_path(scene_, x, y, sampler, out, time_);
  Ray ray = start.ray;
  const ShadingContext context{ray.time};
  const NextEvent alone{lights_}, weighted{lights_, true};
  NoRecorder recorder;
  PathFeatures features;
  Spectrum beta(1.0f);
  float eta_scale = 1.0f;    // what refraction has taken off beta, given back for roulette alone
  float scatter_pdf = 0.0f;  // density of the last direction; 0 where light sampling did not look for the same light
  LightReceiver last;        // the vertex that it left
  const auto add = [&](int depth, const Spectrum& radiance) {
    if (!(depth == 0 ? settings_.emission : depth == 1 ? settings_.direct : settings_.indirect)) return;
    (depth == 0 ? out.emission : depth == 1 ? out.direct : out.indirect) += beta * radiance;
  };
  const auto add_emission = [&](int depth, uint32_t light, const SurfacePoint* on_light) {
    const Spectrum radiance = scene_.lights[light].emitted(on_light, -ray.d, context, ray.o);
    if (is_black(radiance)) return;
    float weight = 1.0f;
    if (scatter_pdf > 0.0f) {
      const float pdf = scene_.lights[light].pdf_li(last.p, ray.d, on_light, context, weighted.sampling());
      weight = mis_weight(weighted.heuristic, scatter_pdf, lights_.probability(light, &last) * pdf);
    }
    add(depth, radiance * weight);
  };

  for (int depth = 0;; ++depth) {
    Hit hit;
    ++(depth == 0 ? out.rays.camera : out.rays.indirect);
    if (!scene_.intersect(ray, hit)) {
      for (const uint32_t light : scene_.infinite_lights) add_emission(depth, light, nullptr);
      break;
    }
    const SurfaceHit surface = scene_.surface(hit);
    const SurfacePoint& point = surface.point;
    const Vec3 wo = -ray.d;
    features.meet(scene_, depth, hit, out);
    if (surface.light != kNoId) add_emission(depth, surface.light, &point);

    const uint32_t dimension = kCameraDimensions + static_cast<uint32_t>(depth) * kVertexDimensions;
    HashStream rng(sampler.key(dimension));
    const Shading shading = scene_.shade(surface, context, rng);
    const SurfaceScatter scatter(shading.closure(), shading.frame, point.ng);
    const Bsdf& bsdf = scatter.bsdf();
    features.shade(point, scatter, wo, out);
    if (depth == settings_.max_depth) break;

    // What scattering cannot find from here, or is not asked for.
    const bool near_delta = is_near_delta(bsdf);
    if (bsdf.has_smooth_lobe()) {
      if (near_delta || !settings_.direct_photons) {
        sampler.set_dimension(dimension + kLightChoice);
        add(depth + 1, next_event(scene_, near_delta ? weighted : alone, {point, GuidedScatter(scatter), ray, context},
                                  sampler, rng, out.rays, recorder));
      }
      Spectrum direct;
      const Spectrum indirect = photon_light(point, scatter, wo, depth, near_delta, rng, direct);
      add(depth + 1, direct);
      add(2, indirect);
    }
    if (!near_delta && (bsdf.lobes() & kDelta) == 0) break;

    sampler.set_dimension(dimension + kScatter);
    const auto s = scatter.sample(wo, sampler.get_3d(), TransportMode::kRadiance, rng);
    if (!s || !(near_delta || s->is_delta())) break;
    beta *= s->weight;
    if (s->is_transmission()) eta_scale *= sqr(s->eta);
    scatter_pdf = s->is_delta() ? 0.0f : s->pdf;
    last = light_receiver(point, bsdf, wo, context.time);
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
// whose only event is at the point comes in `direct`. `hidden`: only of photons that are.
Spectrum SppmIntegrator::photon_light(const SurfacePoint& point, const SurfaceScatter& scatter, Vec3 wo, int depth,
                                      bool hidden, HashStream& rng, Spectrum& direct) const {
  Spectrum indirect;
  grid_.for_photons_near(point.p, radius_, [&](const Photon& photon) {
    if (depth + photon.events + 1 > settings_.max_depth || (hidden && !photon.hidden)) return;
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
