// The pictures of one run of `render`: a scene is read once and seen by one camera after the other.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace etd::cli {

struct View {
  std::string camera;                // the file that says how the scene is looked at; empty: the scene itself
  std::vector<std::string> outputs;  // empty: the file that the film names
};

// Gives each camera the outputs behind it on the command line; one camera alone, or the scene's own, has all of them.
// `camera` and `output` are the options of `command` that took the values, in their order. Throws CLI::ValidationError
// for an output before the first of several cameras.
std::vector<View> pair_views(const CLI::App& command, const CLI::Option* camera,
                             const std::vector<std::string>& cameras, const CLI::Option* output,
                             const std::vector<std::string>& outputs);

// "a.exr, b.exr" of these views and all behind them, or the cameras of those that have no outputs.
std::string outputs_text(const std::vector<View>& views, size_t first);

}  // namespace etd::cli
