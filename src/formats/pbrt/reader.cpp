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

void finish(Parser& p, const SourceLoc& end) {
  p.report_open_blocks(0);
  if (!p.any_directive)
    p.diagnostics.error(end, "the scene is empty", "not one directive stands in it");
  else if (!p.world_begun && !p.world_implied)
    p.diagnostics.error(end, "the scene has no WorldBegin", "options come first, then WorldBegin, then the world");
  p.names.resolve(p.scene, p.diagnostics);
  fill_defaults(p.scene);
  if (p.seed && !p.scene.sampler.find("seed")) p.scene.sampler.params.push_back(integer_param("seed", *p.seed));
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
  return std::move(parser.scene);
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
  return std::move(parser.scene);
}

}  // namespace etd
