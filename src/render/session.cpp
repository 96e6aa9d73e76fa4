#include "render/session.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>

#include "core/freed_memory.h"
#include "integrators/make_integrator.h"
#include "render/memory.h"
#include "render/provenance.h"
#include "render/threads.h"
#include "scene/info.h"
#include "scene/scene.h"

namespace etd {
namespace {

// An image larger than the machine is a slip of the keyboard, better reported than met as a killed process.
void check_film_memory(const RenderSettings& settings, Diagnostics& diagnostics) {
  const double needed = static_cast<double>(Film::bytes_for(settings.film));
  const double present = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (needed <= present) return;
  diagnostics.error(
      {},
      fmt::format("the film needs {:.1f} GiB, and the machine has {:.1f}", needed / (1u << 30), present / (1u << 30)),
      "a smaller size or crop, fewer replicates or no features make it smaller");
}

std::string bias_of(const PreparedRender& prepared) {
  const std::string own = prepared.integrator->bias();
  if (prepared.substitutes.empty()) return own;
  return fmt::format("{}{}with substitutes ({})", own, own.empty() ? "" : "; ", prepared.substitutes);
}

}  // namespace

std::optional<PreparedRender> prepare_render(const SceneDescription& description, const RenderOverrides& overrides,
                                             Diagnostics& diagnostics, CompiledScene compiled, SceneFiles* files,
                                             const LoadMonitor& monitor) {
  const auto start = std::chrono::steady_clock::now();
  PreparedRender prepared;
  prepared.scene_file = description.file;
  prepared.camera_file = description.camera_file;
  prepared.scene_hash = hash_scene(description, diagnostics.sources());
  prepared.overrides = overrides;
  prepared.allow_unsupported = diagnostics.allow_unsupported();
  prepared.limits = diagnostics.limits();
  prepared.settings = make_settings(description, overrides, diagnostics);
  const RenderSettings& settings = prepared.settings;
  check_film_memory(settings, diagnostics);

  TbbThreads threads(settings.driver.threads);  // building the accelerator is parallel too
  prepared.compiled = std::move(compiled);
  if (!prepared.compiled.scene)
    prepared.compiled = threads.run([&] {
      return compile(description,
                     {.width = settings.film.width,
                      .height = settings.film.height,
                      .spp = settings.spp,
                      .textures = settings.textures,
                      .files = files,
                      .monitor = monitor},
                     diagnostics);
    });
  if (diagnostics.has_errors() || !prepared.compiled.scene) return {};
  if (settings.film.ids) prepared.labels = label_ids(prepared.compiled.info->names, diagnostics);
  const IntegratorContext context{.sampler = settings.sampler,
                                  .seed = settings.seed,
                                  .width = settings.film.width,
                                  .height = settings.film.height,
                                  .crop = settings.film.crop,
                                  .tile_size = settings.tile_size,
                                  .replicates = settings.film.all_replicates()};
  prepared.integrator = make_integrator(settings.integrator, *prepared.compiled.scene, context, diagnostics);
  if (diagnostics.has_errors()) return {};
  prepared.substitutes = fmt::format("{}", fmt::join(diagnostics.substitutes(), "; "));
  prepared.load_peak_bytes = peak_memory_bytes();
  prepared.build_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return prepared;
}

FinishedRender run_render(PreparedRender& prepared, RenderObserver& observer, const std::atomic<bool>* stop) {
  FilmSettings film = prepared.settings.film;
  film.feature_space = film.feature_space * Transform::translate(prepared.compiled.scene->origin);
  return_freed_memory();
  FinishedRender finished{Film(film), {}};
  const AddressReserve for_writing(writing_bytes(layers_header(film, true)));
  finished.result = render(*prepared.integrator, finished.film, prepared.settings.driver, observer, stop);
  return finished;
}

RowImage finished_rows(const PreparedRender& prepared, const FinishedRender& finished, bool replicate_layers) {
  RowImage image = layer_rows(finished.film, replicate_layers);
  image.half = prepared.settings.half;
  image.metadata = make_metadata(prepared.scene_file, prepared.settings, bias_of(prepared), finished.result);
  if (!prepared.camera_file.empty())
    image.metadata.emplace_back("etendue:camera", prepared.camera_file.filename().string());
  const bool correlated = prepared.settings.film.correlated;
  image.metadata.emplace_back("etendue:pixels", std::string(correlated ? "correlated" : "independent"));
  if (prepared.settings.film.ids) add_manifests(prepared.labels, finished.film, image.metadata);
  add_provenance(prepared, finished, image.metadata);
  return image;
}

LayeredImage finished_image(const PreparedRender& prepared, const FinishedRender& finished, bool replicate_layers) {
  return all_rows(finished_rows(prepared, finished, replicate_layers));
}

RenderStats finished_stats(const PreparedRender& prepared, const FinishedRender& finished) {
  RenderStats stats;
  stats.build_seconds = prepared.build_seconds;
  stats.render_seconds = finished.result.seconds;
  stats.first_pass_seconds = finished.result.first_pass_seconds;
  stats.rays = finished.result.rays;
  stats.invalid = finished.result.invalid;
  stats.spp = finished.result.spp;
  stats.peak_bytes = peak_memory_bytes();
  stats.load_peak_bytes = prepared.load_peak_bytes;
  stats.geometry_bytes = prepared.compiled.scene->geometry_bytes();
  stats.accelerator_bytes = prepared.compiled.scene->accelerator->bytes();
  stats.texture_bytes = prepared.compiled.scene->textures.image_bytes();
  count_pixels(finished.film, stats);
  return stats;
}

}  // namespace etd
