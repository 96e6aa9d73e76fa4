#include "render/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "film/film_model.h"
#include "integrators/make_integrator.h"
#include "render/other_names.h"
#include "render/overrides.h"
#include "render/registry.h"

namespace etd {
namespace {

// Descriptions that were not read from a file may leave these to us.
void fill_empty(ModelUse& use, const char* model) {
  if (use.model.empty()) use.model = model;
}

// The overrides without those that are out of range, which are reported.
RenderOverrides checked(RenderOverrides o, Diagnostics& diagnostics) {
  const auto check = [&](auto& value, bool ok, const char* message) {
    if (!value || ok) return;
    diagnostics.error({}, message);
    value.reset();
  };
  const auto [width, height] = o.size.value_or(std::pair(1, 1));
  check(o.size, width >= 1 && height >= 1 && width <= kMaxImageSide && height <= kMaxImageSide,
        "the image size must be from 1x1 to 65536x65536 pixels");
  check(o.spp, o.spp >= 1u && o.spp <= kMaxSpp, "spp must be from 1 to 2^30");
  check(o.seconds, o.seconds > 0.0, "the time limit must be positive");
  check(o.error, o.error > 0.0 && o.error < HUGE_VAL, "the error to stop at must be positive");
  check(o.replicates, o.replicates >= 1u && o.replicates <= 4096u, "replicates must be from 1 to 4096");
  check(o.threads, o.threads >= 0 && o.threads <= 1024, "threads must be from 0 (all cores) to 1024");
  check(o.tile_size, o.tile_size >= 1 && o.tile_size <= 4096, "the tile size must be from 1 to 4096 pixels");
  return o;
}

// How long the camera's shutter is open. One that opens for an instant is to freeze the picture, not to darken it.
double shutter_seconds(const ModelUse& camera) {
  const auto number = [&](std::string_view name, double otherwise) {
    const Param* p = camera.find(name);
    return p && p->numbers.size() == 1 ? p->numbers[0] : otherwise;
  };
  const double seconds = number("shutterclose", 1) - number("shutteropen", 0);
  return seconds > 0 ? seconds : 1;
}

void read_film(const ModelUse& use, const SceneDescription& description, const RenderOverrides& overrides,
               RenderSettings& settings, Diagnostics& diagnostics) {
  const FilmModel model = make_film_model(use, {overrides.size, shutter_seconds(description.camera)}, diagnostics);
  FilmSettings& film = settings.film = model.settings;
  settings.filename = model.filename;
  settings.half = model.half;
  if (model.in_camera_space) film.feature_space = description.camera_to_world.start.inverse();
  if (!overrides.crop) return;
  const PixelBounds& c = *overrides.crop;
  if (c.empty() || c.x0 < 0 || c.y0 < 0 || c.x1 > film.width || c.y1 > film.height)
    diagnostics.error({}, fmt::format("the crop {},{},{},{} is not a part of the image", c.x0, c.x1, c.y0, c.y1),
                      fmt::format("it is x0,x1,y0,y1 in pixels with x1 and y1 outside; the image is {} x {} pixels",
                                  film.width, film.height));
  else
    film.crop = c;
}

void read_sampler(const ParamReader& reader, const RenderOverrides& overrides, RenderSettings& settings) {
  settings.sampler = sampler_kind(reader.decl().name);
  settings.seed = overrides.seed.value_or(static_cast<uint64_t>(reader.integer("seed")));
  settings.driver.seconds = overrides.seconds.value_or(settings.driver.seconds);
  settings.textures.limit = overrides.texture_memory.value_or(settings.textures.limit);
  settings.textures.cache_folder = overrides.texture_cache.value_or(settings.textures.cache_folder);
  settings.driver.error = overrides.error.value_or(settings.driver.error);
  const uint32_t r = settings.film.all_replicates();
  const bool samples_set = std::any_of(overrides.set.begin(), overrides.set.end(),
                                       [](const auto& entry) { return entry.first == "sampler.pixelsamples"; });
  settings.spp_unlimited = (overrides.seconds || overrides.error) && !overrides.spp && !samples_set;
  if (settings.spp_unlimited) {
    settings.spp = kMaxSpp / r * r;
    return;
  }
  const uint32_t wanted = overrides.spp.value_or(static_cast<uint32_t>(reader.integer("pixelsamples")));
  settings.spp = (wanted + r - 1) / r * r;
  if (settings.spp != wanted)
    reader.diagnostics().note(
        {}, fmt::format("{} samples per pixel rounded up to {}, a multiple of {} replicates", wanted, settings.spp, r));
  if (settings.driver.error > 0 && settings.spp < kFirstErrorTest)
    reader.diagnostics().warning(
        {}, fmt::format("the error will never be tested: that begins at {} samples per pixel, and only {} are taken",
                        kFirstErrorTest, settings.spp));
}

SourceLoc command_line(const std::string& text, Diagnostics& diagnostics) {
  const auto length = static_cast<int32_t>(text.size());
  return {diagnostics.sources().add("command line", text), 1, 1, std::max(1, length)};
}

// Puts another integrator in place of the scene's. It keeps those parameters of the scene's that it has.
void replace_integrator(ModelUse& use, const std::string& name, Diagnostics& diagnostics) {
  const ModelUse of_scene = use;
  use = {name, {}, command_line(name, diagnostics)};
  take_other_name(Family::kIntegrator, use, diagnostics);
  const ModelDecl* decl = find_any_model(Family::kIntegrator, use.model);
  if (!decl) return;  // reported by require_model()
  std::string dropped;
  for (const Param& p : of_scene.params)
    if (decl->find(p.name))
      use.params.push_back(p);
    else
      dropped += (dropped.empty() ? "" : ", ") + p.name;
  if (!dropped.empty())
    diagnostics.note(of_scene.loc, fmt::format("integrator \"{}\" has none of these parameters, which the scene "
                                               "sets for \"{}\": {}",
                                               use.model, of_scene.model, dropped));
}

// What the integrator can and cannot give.
void apply_traits(const RenderOverrides& overrides, RenderSettings& settings, Diagnostics& diagnostics) {
  const std::string& name = settings.integrator.model;
  const IntegratorTraits& traits = settings.traits = integrator_traits(name);
  FilmSettings& film = settings.film;
  film.splats = traits.splats;
  film.correlated = traits.correlated_pixels;
  uint32_t& replicates = film.of_replicates;
  replicates = overrides.replicates.value_or(traits.correlated_pixels ? kCorrelatedReplicates : 1);
  if (traits.correlated_pixels && replicates < kReplicatesForSpread) {
    diagnostics.error({}, fmt::format("integrator \"{}\" needs at least {} replicates: no sample of it belongs to one "
                                      "pixel alone, so only their spread tells the error",
                                      name, kReplicatesForSpread));
    replicates = kReplicatesForSpread;
  }
  film.replicates = replicates;
  if (const auto range = overrides.replicate_range) {
    std::tie(film.first_replicate, film.replicates) = *range;
    if (range->second == 0 || uint64_t{range->first} + range->second > replicates)
      diagnostics.error({}, fmt::format("there are no replicates {} to {}: the image has {}, counted from 0",
                                        range->first, uint64_t{range->first} + range->second - 1, replicates));
  }
  film.features = overrides.features.value_or(true) && traits.features;
  film.alpha = overrides.alpha.value_or(false);
  film.ids = overrides.ids.value_or(false);
  if (!traits.features && (film.alpha || film.ids))
    diagnostics.error(
        {}, fmt::format("integrator \"{}\" does not look at the scene from the camera, so there {} for it", name,
                        film.alpha ? "is no alpha" : "are no layers of ids"));
}

}  // namespace

RenderSettings make_settings(const SceneDescription& description, const RenderOverrides& wanted,
                             Diagnostics& diagnostics) {
  const RenderOverrides overrides = checked(wanted, diagnostics);
  RenderSettings settings;
  ModelUse film = description.film, sampler = description.sampler;
  settings.integrator = description.integrator;
  fill_empty(film, "rgb");
  fill_empty(sampler, "sobol");
  fill_empty(settings.integrator, "path");

  settings.driver.threads = overrides.threads.value_or(settings.driver.threads);
  settings.tile_size = overrides.tile_size.value_or(settings.tile_size);
  if (overrides.sampler) {
    sampler.model = *overrides.sampler;
    sampler.loc = command_line(sampler.model, diagnostics);
    take_other_name(Family::kSampler, sampler, diagnostics);
  }
  if (overrides.integrator) replace_integrator(settings.integrator, *overrides.integrator, diagnostics);
  apply_overrides(overrides.set, {film, sampler, settings.integrator}, diagnostics);

  const ModelDecl* film_decl = require_model(Family::kFilm, film, diagnostics);
  const ModelDecl* sampler_decl = require_model(Family::kSampler, sampler, diagnostics);
  const ModelDecl* integrator_decl = require_model(Family::kIntegrator, settings.integrator, diagnostics);
  if (film_decl) {
    check_params(*film_decl, film, diagnostics);
    read_film(film, description, overrides, settings, diagnostics);
  }
  apply_traits(overrides, settings, diagnostics);
  if (sampler_decl) {
    check_params(*sampler_decl, sampler, diagnostics);
    read_sampler(ParamReader(*sampler_decl, sampler, diagnostics), overrides, settings);
  }
  if (integrator_decl) check_params(*integrator_decl, settings.integrator, diagnostics);
  const FilmSettings& f = settings.film;
  settings.driver.spp = settings.spp / f.all_replicates() * f.replicates;
  return settings;
}

}  // namespace etd
