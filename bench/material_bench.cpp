// Nanoseconds per shading point by material: what a vertex of a path asks of its surface. The points are those where
// paths of the model scenes (tests/scenes/models/material-MODEL.pbrt, and those with a rough surface, a normal map or a
// bump) meet the material; a new material has such a scene, and so it is measured without anything being added here.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <exception>
#include <string>
#include <vector>

#include "core/flush_to_zero.h"
#include "core/warp.h"
#include "materials/surface_scatter.h"
#include "recorded_paths.h"
#include "scene/info.h"

namespace {

using namespace etd;
namespace fs = std::filesystem;

constexpr size_t kPoints = 4096;  // fits a cache, as what a path has just met does

struct ShadingPoint {
  SurfaceHit surface;
  Vec3 wo, wi;  // wi: where the sampled light is, or some direction
};

// The material that a model scene is about: "conductor" of material-conductor-roughness.pbrt.
std::string model_of(const fs::path& file) {
  const std::string name = file.stem().string();
  const size_t begin = name.find('-') + 1;
  return name.substr(begin, name.find('-', begin) - begin);
}

std::vector<ShadingPoint> record_points(const PreparedRender& prepared, const std::string& model) {
  const Scene& scene = *prepared.compiled.scene;
  const SceneNames& names = prepared.compiled.info->names;
  HashStream numbers(1);
  std::vector<ShadingPoint> points;
  for_each_path(prepared, [&](const PathRecord& path) {
    for (const PathVertex& v : path.vertices) {
      if (!v.on_surface || names.materials[scene.binding_of(v.hit).material].model != model) continue;
      const float a = numbers.next_float(), b = numbers.next_float();
      const Vec3 around = Frame::from_z(v.surface.point.ng).to_world(sample_hemisphere_cosine({a, b}));
      points.push_back({v.surface, v.wo, v.light && v.light->sample ? v.light->sample->wi : around});
    }
  });
  // Neighbours in the picture stay neighbours.
  const size_t step = std::max<size_t>(1, points.size() / kPoints);
  std::vector<ShadingPoint> some;
  for (size_t i = 0; i < points.size() && some.size() < kPoints; i += step) some.push_back(points[i]);
  return some;
}

// The closure and its frame, its value and density for the direction of a light, and a direction to go on in.
void material(benchmark::State& state, const fs::path& file) try {
  RenderOverrides overrides;
  overrides.size = {32, 32};
  overrides.spp = 16, overrides.replicates = 1;
  const PreparedRender prepared = load_for_bench(file, overrides);
  const std::vector<ShadingPoint> points = record_points(prepared, model_of(file));
  if (points.empty()) return state.SkipWithError("no path meets the material");
  const FlushToZero mode;
  HashStream rng(2);
  size_t i = 0;
  for (auto _ : state) {
    const ShadingPoint& p = points[i];
    i = i + 1 < points.size() ? i + 1 : 0;
    const Shading shading = prepared.compiled.scene->shade(p.surface, {}, rng);
    const SurfaceScatter scatter(shading.closure(), shading.frame, p.surface.point.ng);
    if (scatter.bsdf().has_smooth_lobe()) benchmark::DoNotOptimize(scatter.eval_pdf(p.wo, p.wi, rng));
    const Vec3 u{rng.next_float(), rng.next_float(), rng.next_float()};
    benchmark::DoNotOptimize(scatter.sample(p.wo, u, TransportMode::kRadiance, rng));
  }
} catch (const std::exception& e) {
  state.SkipWithError(e.what());
}

// With its defaults, or changed in a way that changes the work.
bool is_measured(const std::string& name) {
  if (!name.starts_with("material-") || name == "material-interface") return false;
  if (std::count(name.begin(), name.end(), '-') == 1) return true;
  for (const char* ending :
       {"-roughness", ".roughness", "-uroughness", "-albedo", "-normalmap", "-displacement", "-energycompensation"})
    if (name.ends_with(ending)) return true;
  return false;
}

const bool kRegistered = [] {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(ETENDUE_MODEL_SCENES, ignored))
    if (entry.path().extension() == ".pbrt" && is_measured(entry.path().stem().string())) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files)
    benchmark::RegisterBenchmark(("material/" + file.stem().string().substr(9)).c_str(),
                                 [file](benchmark::State& state) { material(state, file); });
  return true;
}();

}  // namespace
