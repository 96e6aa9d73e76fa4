#include "formats/pbrt/reader.h"

#include "formats/pbrt/parser.h"

namespace etd {

namespace {

using pbrt::Parser;

// What the format prescribes when the file is silent; the models' own defaults give the rest.
void fill_defaults(SceneDescription& scene) {
  const auto fill = [](ModelUse& use, std::string_view model) {
    if (use.model.empty()) use.model = model;
  };
  fill(scene.camera, "perspective");
  fill(scene.film, "rgb");
  fill(scene.filter, "gaussian");
  fill(scene.sampler, "sobol");
  fill(scene.integrator, "path");
}

Param integer_param(std::string name, int32_t value) {
  Param p;
  p.name = std::move(name);
  p.kind = ParamKind::kInteger;
  p.integers = {value};
  return p;
}

void set_seed(ModelUse& sampler, int32_t seed) {
  if (!sampler.find("seed")) sampler.params.push_back(integer_param("seed", seed));
}

void finish(Parser& p, const SourceLoc& end) {
  p.report_open_blocks(0);
  if (!p.any_directive)
    p.diagnostics.error(end, "the scene is empty", "not one directive stands in it");
  else if (!p.world_begun && !p.world_implied)
    p.diagnostics.error(end, "the scene has no WorldBegin", "options come first, then WorldBegin, then the world");
  p.names.resolve(p.scene, p.diagnostics);
  fill_defaults(p.scene);
  if (p.seed) set_seed(p.scene.sampler, *p.seed);
}

// Those that were added since.
std::vector<int32_t> sources_from(int32_t first, const Diagnostics& diagnostics) {
  std::vector<int32_t> all;
  for (int32_t i = first; i < diagnostics.sources().count(); ++i) all.push_back(i);
  return all;
}

// Files that a camera names are looked for beside the camera's file first; the scene's folder is that of the scene.
void find_files(ModelUse& use, const std::filesystem::path& folder) {
  for (Param& p : use.params)
    for (std::string& name : p.strings) {
      std::error_code failed;
      if (p.kind != ParamKind::kString || !std::filesystem::is_regular_file(folder / name, failed)) continue;
      name = std::filesystem::absolute(folder / name, failed).lexically_normal().string();
    }
}

}  // namespace

SceneDescription read_pbrt(const std::filesystem::path& file, Diagnostics& diagnostics) {
  SceneDescription scene;
  scene.file = file;
  scene.folder = file.parent_path();
  pbrt::TokenStream tokens(scene.folder, diagnostics);
  const int32_t source = tokens.push_main(file);
  Parser parser(std::move(scene), std::move(tokens), diagnostics);
  if (source < 0) {
    fill_defaults(parser.scene);
    return std::move(parser.scene);
  }
  parser.read_directives();
  finish(parser, {source, 0, 0, 1});
  parser.scene.sources = sources_from(source, diagnostics);
  return std::move(parser.scene);
}

ViewDescription read_pbrt_view(const std::filesystem::path& file, const ViewDescription& view,
                               Diagnostics& diagnostics) {
  ViewDescription result = view;
  result.camera_file = file;
  pbrt::TokenStream tokens(file.parent_path(), diagnostics);
  const int32_t source = tokens.push_main(file);
  if (source < 0) return result;
  SceneDescription scene;
  scene.folder = file.parent_path();
  Parser parser(std::move(scene), std::move(tokens), diagnostics);
  parser.ends_at_world = true;
  parser.read_directives();
  parser.report_open_blocks(0);
  const ViewDescription& read = parser.scene;
  if (read.camera.loc.file < 0)
    diagnostics.error({source, 0, 0, 1}, "the file has no Camera",
                      "--camera takes a scene, or what a scene says before its WorldBegin");
  const auto replace = [](ModelUse& use, const ModelUse& by) {
    if (by.loc.file >= 0) use = by;
  };
  replace(result.camera, read.camera);
  find_files(result.camera, file.parent_path());
  result.camera_to_world = read.camera_to_world;
  replace(result.film, read.film);
  replace(result.filter, read.filter);
  replace(result.sampler, read.sampler);
  replace(result.integrator, read.integrator);
  if (!read.filter_textures) result.filter_textures = false;
  if (parser.transform_times.file >= 0) result.motion_start = read.motion_start, result.motion_end = read.motion_end;
  if (parser.seed && !read.sampler.find("seed")) {
    std::erase_if(result.sampler.params, [](const Param& p) { return p.name == "seed"; });
    set_seed(result.sampler, *parser.seed);
  }
  const std::vector<int32_t> own = sources_from(source, diagnostics);
  result.sources.insert(result.sources.end(), own.begin(), own.end());
  return result;
}

SceneDescription read_pbrt_text(std::string text, const std::string& name, const std::filesystem::path& folder,
                                Diagnostics& diagnostics) {
  SceneDescription scene;
  scene.file = name;
  scene.folder = folder;
  pbrt::TokenStream tokens(folder, diagnostics);
  const int32_t source = tokens.push_text(std::move(text), name);
  Parser parser(std::move(scene), std::move(tokens), diagnostics);
  parser.read_directives();
  finish(parser, {source, 0, 0, 1});
  parser.scene.sources = sources_from(source, diagnostics);
  return std::move(parser.scene);
}

}  // namespace etd
