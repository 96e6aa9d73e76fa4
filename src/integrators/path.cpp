#include "integrators/path.h"

#include <fmt/format.h>

#include <algorithm>

#include "accel/spawn.h"
#include "integrators/camera_path.h"
#include "integrators/guiding/guided_roulette.h"
#include "integrators/guiding/guided_scatter.h"
#include "integrators/light.h"
#include "integrators/light_path.h"
#include "integrators/next_event.h"
#include "integrators/path_record.h"
#include "materials/bent_normal.h"
#include "materials/surface_scatter.h"
#include "scene/visibility.h"

namespace etd {

constexpr int kRouletteDepth = 5;  // least error at equal time (docs/performance.md)

const ModelDecl& PathIntegrator::decl() {
  static const ModelDecl d = with_params(
      {Family::kIntegrator,
       "path",
       "Path tracing from the camera with next-event estimation and multiple importance sampling.",
       {}},
      {transport_params(kRouletteDepth),
       {{.name = "mode",
         .type = ParamType::kString,
         .default_value = std::string("mis"),
         .choices = {"mis", "next_event", "naive"},
         .doc = "How light is found: by sampling lights and closures together, lights alone, or closures alone."},
        {.name = "misheuristic",
         .type = ParamType::kString,
         .default_value = std::string("power"),
         .choices = {"power", "balance", "maximum", "uniform"},
         .doc = "How mode mis weights the two ways to find light; never changes the mean."},
        {.name = "shadingnormals",
         .type = ParamType::kString,
         .default_value = std::string("exact"),
         .choices = {"exact", "bent"},
         .doc = "Shading normals as they are, or bent towards the viewer where a mirror would show the inside of the "
                "surface, which is black."},
        {.name = "guiding",
         .type = ParamType::kString,
         .default_value = std::string("off"),
         .choices = {"off", "sdtree"},
         .doc =
             "How directions are chosen: by the closures alone, or also by the light that photons have brought before "
             "the first sample, kept in an SD-tree; never changes the mean."},
        {.name = "guidingpaths",
         .type = ParamType::kInteger,
         .default_value = 1000000,
         .min = 1,
         .max = 1 << 26,
         .doc =
             "Paths from lights whose photons guide; more take longer before the first sample, and memory: 400 bytes "
             "each at most."},
        {.name = "paths",
         .type = ParamType::kString,
         .default_value = std::string("all"),
         .choices = {"all", "from_lights"},
         .doc = "Which paths to render: all, or those alone that the integrator light finds too. It misses infinite "
                "lights seen directly, and surfaces that reflect like mirrors or refract like glass between the camera "
                "and what it sees."}}});
  return d;
}

namespace {

bool has_delta_lights(const Scene& scene) {
  return std::any_of(scene.lights.begin(), scene.lights.end(), [](const Light& l) { return l.is_delta(); });
}

}  // namespace

PathSettings PathIntegrator::settings(const ParamReader& p) {
  PathSettings s{transport_settings(p)};
  const std::string mode = p.string("mode");
  s.mode = mode == "naive" ? PathMode::kNaive : mode == "next_event" ? PathMode::kNextEvent : PathMode::kMis;
  s.heuristic = mis_heuristic(p.string("misheuristic"));
  s.bent_normals = p.string("shadingnormals") == "bent";
  s.guiding = p.string("guiding") == "sdtree";
  s.guiding_paths = static_cast<uint64_t>(p.integer("guidingpaths"));
  s.from_lights = p.string("paths") == "from_lights";
  return s;
}

std::unique_ptr<Integrator> PathIntegrator::create(const ParamReader& p, const Scene& scene,
                                                   const IntegratorContext& context) {
  return std::make_unique<PathIntegrator>(scene, settings(p), context);
}

std::vector<Variant> PathIntegrator::variants(const Scene& scene, int max_depth) {
  // Without roulette, longer paths cost too much.
  constexpr int kLongestWithoutRoulette = 64;
  const bool delta = has_delta_lights(scene);
  const std::string too_short = max_depth < 2 ? "paths have one event at most" : "";
  const std::string too_long = max_depth > kLongestWithoutRoulette
                                   ? fmt::format("paths may have {} events; --max-depth {} would make it apply",
                                                 max_depth, kLongestWithoutRoulette)
                                   : "";
  std::vector<Variant> all{{.name = "mis"},
                           {.name = "naive",
                            .set = {{"mode", "naive"}},
                            .not_applicable = delta ? "no ray meets lights without extent" : ""},
                           {.name = "next_event", .set = {{"mode", "next_event"}}, .samples_lights_alone = true}};
  for (const ModelDecl* sampler : sampler_models())
    if (sampler->name != SamplerKind().name()) all.push_back({.name = sampler->name, .sampler = sampler->name});
  all.push_back({.name = "balance heuristic", .set = {{"misheuristic", "balance"}}});
  for (const LightSamplerModel& m : light_sampler_models())
    if (m.name != scene.light_sampler.name())
      all.push_back({.name = "lights " + m.doc,
                     .set = {{"lightsampler", m.name}},
                     .not_applicable = scene.lights.size() < 2 ? "there is one light at most" : ""});
  all.push_back({.name = "guided", .set = {{"guiding", "sdtree"}, {"guidingpaths", "20000"}}});
  all.push_back({.name = "roulette from 1", .set = {{"roulettedepth", "1"}}, .not_applicable = too_short});
  all.push_back({.name = "no roulette",
                 .set = {{"roulettedepth", "1048576"}},
                 .not_applicable = too_short.empty() ? too_long : too_short});
  return all;
}

PathIntegrator::PathIntegrator(const Scene& scene, const PathSettings& settings, const IntegratorContext& context)
    : PixelIntegrator(context), scene_(scene), settings_(settings), lights_(light_sampler_of(scene, settings)) {
  if (!settings.guiding) return;
  const bool finds_direct = settings.mode != PathMode::kNaive;
  guide_ = std::make_unique<GuideTraining>(
      scene, lights_, GuideSettings{settings.guiding_paths, settings.max_depth, finds_direct}, context);
}

std::string PathIntegrator::bias() const {
  std::vector<std::string> all;
  if (has_delta_lights(scene_)) {
    if (settings_.mode == PathMode::kNaive)
      all.push_back("lights that no ray meets are left out");
    else if (settings_.indirect && has_mirrors(scene_))
      all.push_back(kUnseenByCameraPaths);
  }
  if (settings_.indirect)
    all.push_back(fmt::format("light after more than {} scattering events is left out", settings_.max_depth));
  if (settings_.from_lights) all.push_back(kUnseenByLightPaths);
  if (settings_.bent_normals) all.push_back("shading normals are bent");
  return fmt::format("{}", fmt::join(all, "; "));
}

namespace {

// Sampler dimensions: those of the camera, then a fixed block per path vertex.
constexpr uint32_t kVertexDimensions = 6;
enum VertexDimension : uint32_t { kLightChoice, kLightPoint, kScatter, kScatterLobe, kRoulette };
static_assert(kCameraDimensions + kRoulette <= DigitBlock::kSize, "the first vertex draws what the start has fetched");

}  // namespace

uint32_t PathIntegrator::phases(const Pass& pass) const {
  return PixelIntegrator::phases(pass) + (guide_ && !guide_->guide().built() ? GuideTraining::kPhases : 0);
}

bool PathIntegrator::in_training(uint32_t phase) const {
  return guide_ && !guide_->guide().built() && phase < GuideTraining::kPhases;
}

void PathIntegrator::begin(const Pass&, uint32_t phase) {
  if (in_training(phase))
    guide_->begin(phase);
  else if (guide_)
    guide_->end();
}

size_t PathIntegrator::work_items(const Pass& pass, uint32_t phase) const {
  return in_training(phase) ? guide_->work_items(phase) : PixelIntegrator::work_items(pass, phase);
}

void PathIntegrator::render(const Pass& pass, uint32_t phase, size_t item, Sink& sink) {
  if (in_training(phase))
    guide_->run(phase, item);
  else
    PixelIntegrator::render(pass, phase, item, sink);
}

PixelSample PathIntegrator::sample_pixel(int x, int y, Sampler& sampler) const {
  return trace(x, y, sampler, NoRecorder());
}

PixelSample PathIntegrator::record_pixel(int x, int y, Sampler& sampler, PathRecord& record) const {
  if (guide_) guide_->run_all();
  return trace(x, y, sampler, PathRecorder(record));
}

template <class Recorder>
PixelSample PathIntegrator::trace(int x, int y, Sampler& sampler, Recorder recorder) const {
  PixelSample out;
  sampler.fetch(0);
  const CameraPathStart start = start_camera_path(scene_, x, y, sampler, out);
  Ray ray = start.ray;
  const ShadingContext context{ray.time};
  recorder.camera(start.sample, ray);

  const bool mis = settings_.mode == PathMode::kMis;
  const NextEvent how{lights_, mis, settings_.heuristic};
  PathFeatures features;
  Spectrum beta(1.0f);          // throughput: the product of f cos / pdf so far
  float eta_scale = 1.0f;       // what refraction has taken off beta, given back for roulette alone
  float scatter_pdf = 0.0f;     // density of the last direction per solid angle
  bool only_scattering = true;  // the last direction could not have come from light sampling
  LightReceiver last;           // the vertex it left
  GuidedRoulette roulette;

  const auto add = [&](LightFoundBy by, int depth, const Spectrum& radiance) {
    if (!(depth == 0 ? settings_.emission : depth == 1 ? settings_.direct : settings_.indirect)) return;
    (depth == 0 ? out.emission : depth == 1 ? out.direct : out.indirect) += radiance;
    recorder.contribution(by, radiance);
  };
  // Emission that scattering found, weighted: light sampling could have found it with density pdf_light.
  const auto add_emission = [&](int depth, uint32_t light, const SurfacePoint* on_light) {
    const Spectrum radiance = scene_.lights[light].emitted(on_light, -ray.d, context, ray.o);
    if (is_black(radiance)) return;
    float pdf_light = 0.0f, weight = 1.0f;
    if (!only_scattering && settings_.mode == PathMode::kNextEvent) weight = 0.0f;
    if (!only_scattering && mis) {
      const float pdf = scene_.lights[light].pdf_li(last.p, ray.d, on_light, context, how.sampling());
      pdf_light = lights_.probability(light, &last) * pdf;
      weight = mis_weight(settings_.heuristic, scatter_pdf, pdf_light);
    }
    recorder.emission(light, radiance, scatter_pdf, pdf_light, weight);
    add(LightFoundBy::kScattering, depth, beta * radiance * weight);
  };

  for (int depth = 0;; ++depth) {
    // Find the next vertex.
    recorder.vertex(depth, beta, -ray.d);
    Hit hit;
    ++(depth == 0 ? out.rays.camera : out.rays.indirect);
    if (!scene_.intersect(ray, hit)) {
      if (depth > 0 || !settings_.from_lights)
        for (uint32_t light : scene_.infinite_lights) add_emission(depth, light, nullptr);
      recorder.end(PathEnd::kEscaped);
      break;
    }
    const SurfaceHit surface = scene_.surface(hit);
    const SurfacePoint& point = surface.point;
    const Vec3 wo = -ray.d;
    features.meet(scene_, depth, hit, out);

    // Light that the vertex emits.
    if (surface.light != kNoId) add_emission(depth, surface.light, &point);

    const uint32_t dimension = kCameraDimensions + static_cast<uint32_t>(depth) * kVertexDimensions;
    HashStream rng(sampler.key(dimension));
    if (depth > 0) sampler.fetch(dimension);
    Shading shading = scene_.shade(surface, context, rng);
    if (settings_.bent_normals) shading.frame = bend_to_viewer(shading.frame, point.ng, wo);
    const SurfaceScatter scatter(shading.closure(), shading.frame, point.ng);
    const Bsdf& bsdf = scatter.bsdf();
    const GuideCell* cell = guide_ ? guide_->guide().find(point.p, face_forward(point.ng, wo)) : nullptr;
    const GuidedScatter guided(scatter, cell);
    recorder.surface(hit, surface, shading);
    features.shade(point, scatter, wo, out);
    if (depth == settings_.max_depth) {
      recorder.end(PathEnd::kDepth);
      break;
    }

    // Light that arrives straight from a light.
    if (settings_.mode != PathMode::kNaive && bsdf.has_smooth_lobe()) {
      sampler.set_dimension(dimension + kLightChoice);
      const Spectrum light = next_event(scene_, how, {point, guided, ray, context}, sampler, rng, out.rays, recorder);
      add(LightFoundBy::kLightSampling, depth + 1, beta * light);
    }

    // Light that arrives from elsewhere: continue in a sampled direction.
    sampler.set_dimension(dimension + kScatter);
    const auto s = guided.sample(wo, sampler.get_3d(), rng);
    if (!s) {
      recorder.end(PathEnd::kAbsorbed);
      break;
    }
    recorder.scatter(*s);
    if (settings_.from_lights && depth == 0 && s->is_delta()) {
      recorder.end(PathEnd::kLeftOut);
      break;
    }
    beta *= s->weight;
    if (s->is_transmission()) eta_scale *= sqr(s->eta);
    scatter_pdf = s->pdf;
    only_scattering = s->is_delta();
    last = light_receiver(point, bsdf, wo, context.time);
    ray = spawn_ray(point, s->wi, ray);

    // Russian roulette on the throughput, as it is without the compression of radiance in glass.
    float survival = max_value(beta) * eta_scale;
    if (guide_) survival = roulette.survival(cell, beta * eta_scale, out.albedo, survival);
    if (depth + 1 >= settings_.roulette_depth && survival < 1.0f) {
      sampler.set_dimension(dimension + kRoulette);
      const bool survived = sampler.get_1d() < survival;
      recorder.roulette(survival, survived);
      if (!survived) {
        recorder.end(PathEnd::kRoulette);
        break;
      }
      beta *= 1.0f / survival;
    }
  }
  return out;
}

}  // namespace etd
