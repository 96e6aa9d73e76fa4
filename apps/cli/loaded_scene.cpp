#include "loaded_scene.h"

#include <algorithm>
#include <chrono>

#include "formats/pbrt/reader.h"
#include "printing.h"

namespace etd::cli {
namespace {

// Returns where the picture goes that the scene's film names, with either kind of slash: there if its folder exists,
// seen from the current one, and otherwise into the current one.
std::string output_of_film(std::string filename) {
  std::replace(filename.begin(), filename.end(), '\\', '/');
  const std::filesystem::path wanted = filename;
  std::error_code ignored;
  return std::filesystem::is_directory(wanted.parent_path(), ignored) ? filename : wanted.filename().string();
}

}  // namespace

LoadedScene::LoadedScene(const SceneArguments& args, const std::vector<View>& views, bool quiet)
    : overrides_(args.overrides), bar_(quiet), diagnostics_(args.allow_unsupported, args.limits) {
  const auto start = std::chrono::steady_clock::now();
  bar_.show("reading " + std::filesystem::path(args.scene).filename().string(), 0);
  description_ = load_scene(args.scene, diagnostics_);
  const ViewDescription own = description_;
  for (const View& view : views)
    views_.push_back(view.camera.empty() ? own : read_pbrt_view(view.camera, own, diagnostics_));
  bar_.clear();
  seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void LoadedScene::check_views(std::vector<View>& views) {
  for (size_t i = 0; i < views.size(); ++i) {
    SceneDescription alone;
    static_cast<ViewDescription&>(alone) = views_[i];
    alone.file = description_.file, alone.folder = description_.folder;
    if (const auto prepared = prepare_render(alone, overrides_, diagnostics_)) name_output(*prepared, views[i]);
  }
}

std::optional<PreparedRender> LoadedScene::prepare(size_t view, const std::atomic<bool>* stop) {
  static_cast<ViewDescription&>(description_) = views_[view];
  SceneFiles* kept = views_.size() > 1 ? &files_ : nullptr;
  std::optional<PreparedRender> prepared =
      prepare_render(description_, overrides_, diagnostics_, {}, kept, bar_.monitor(stop));
  bar_.clear();
  if (view + 1 == views_.size()) description_ = SceneDescription(), files_ = SceneFiles();
  if (printed_ == 0) {
    print_diagnostics(diagnostics_);
  } else {
    for (const Diagnostic& d : diagnostics_.all().subspan(printed_)) tell("{}", diagnostics_.format(d));
  }
  printed_ = diagnostics_.all().size();
  return prepared;
}

void name_output(const PreparedRender& prepared, View& view) {
  if (view.outputs.empty()) view.outputs.push_back(output_of_film(prepared.settings.filename));
}

}  // namespace etd::cli
