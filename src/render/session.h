// A whole render as three steps that programs, tests and bindings call: prepare what a description asks for, run it,
// write what came out. Nothing here knows where the description was read from.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "core/loading.h"
#include "film/film.h"
#include "integrators/integrator.h"
#include "params/limits.h"
#include "render/driver.h"
#include "render/manifest.h"
#include "render/output.h"
#include "render/settings.h"
#include "render/stats.h"
#include "scene/compile.h"

namespace etd {

struct PreparedRender {
  std::filesystem::path scene_file, camera_file;
  std::string scene_hash;  // hash_scene()
  RenderOverrides overrides;
  bool allow_unsupported = false;
  Limits limits;
  std::string substitutes;  // all that stand in for what is not supported, separated by "; "
  RenderSettings settings;
  IdLabels labels;         // if ids are kept
  CompiledScene compiled;  // outlives the integrator, which refers to the scene
  std::unique_ptr<Integrator> integrator;
  double build_seconds = 0;
  uint64_t load_peak_bytes = 0;  // the most that the process had held when all this was there
};

// Compiles the scene and makes the integrator. Reports everything that is wrong with description and overrides, also
// when errors were reported before, and returns nothing if there is any error.
// `compiled`: what was compiled before from the same description, for an image of the same size.
// `files`: what was read for the same description with another view, and is read now (scene/compile.h).
// `monitor` is told of the loading, and can stop it: then LoadingStopped is thrown.
std::optional<PreparedRender> prepare_render(const SceneDescription& description, const RenderOverrides& overrides,
                                             Diagnostics& diagnostics, CompiledScene compiled = {},
                                             SceneFiles* files = nullptr, const LoadMonitor& monitor = {});

struct FinishedRender {
  Film film;
  RenderResult result;
};

// Throws std::bad_alloc before anything is rendered where there is no memory for the film and for writing it.
// Renders until all samples are taken, another limit of the settings is reached or `stop` becomes true.
FinishedRender run_render(PreparedRender& prepared, RenderObserver& observer, const std::atomic<bool>* stop = nullptr);

// The image with its layers and metadata, ready for write_output(); with layers for each replicate if they are wanted.
// Its rows are made from the film, which must outlive them.
RowImage finished_rows(const PreparedRender& prepared, const FinishedRender& finished, bool replicate_layers = false);
// The same in memory.
LayeredImage finished_image(const PreparedRender& prepared, const FinishedRender& finished,
                            bool replicate_layers = false);
// All numbers but the seconds of loading, which the caller knows.
RenderStats finished_stats(const PreparedRender& prepared, const FinishedRender& finished);

}  // namespace etd
