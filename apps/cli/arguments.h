// What several commands share: options that change how a scene is rendered, and how a scene is read.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>

#include "params/diagnostics.h"
#include "render/settings.h"

namespace etd::cli {

struct SceneArguments {
  std::string scene;
  std::string camera;  // a file that says how to look at it; empty: the scene's own
  bool allow_unsupported = false;
  Limits limits;
  RenderOverrides overrides;
};

// SCENE, --camera, --allow-unsupported and --limit.
void add_scene_options(CLI::App& command, const std::shared_ptr<SceneArguments>& args);
// --size, --spp, --set and the others that change what is rendered.
void add_override_options(CLI::App& command, const std::shared_ptr<SceneArguments>& args);
// --crop, which sets `to`; it must outlive the parsing.
void add_crop_option(CLI::App& command, std::optional<PixelBounds>& to, const std::string& help);

// Reads a scene in the language that the file's ending names; an unknown ending and everything wrong inside are
// reported, and the description is as complete as could be read.
SceneDescription load_scene(const std::string& path, Diagnostics& diagnostics);
// The same, seen by the camera of the arguments if they name one.
SceneDescription load_scene(const SceneArguments& args, Diagnostics& diagnostics);

// Integers with the given separator between them, "640x360"; nothing when the text is anything else.
std::optional<std::vector<int>> parse_integers(std::string_view text, char separator, size_t count);

// Everything that was found, to stderr.
void print_diagnostics(const Diagnostics& diagnostics);

}  // namespace etd::cli
