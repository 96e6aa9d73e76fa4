// `etendue info`: what is in a scene, and the memory it takes.
#include <fmt/format.h>

#include <map>

#include "arguments.h"
#include "commands.h"
#include "render/session.h"
#include "scene/scene.h"

namespace etd::cli {
namespace {

std::string bytes_text(size_t bytes) {
  constexpr double kMiB = 1024.0 * 1024.0;
  const double mib = static_cast<double>(bytes) / kMiB;
  return mib < 0.1 ? fmt::format("{:.1f} KiB", mib * 1024) : fmt::format("{:.1f} MiB", mib);
}

// "5: 3 diffuse, 2 conductor".
std::string counts_text(const std::map<std::string, size_t>& counts) {
  size_t total = 0;
  std::string parts;
  for (const auto& [name, count] : counts) {
    total += count;
    parts += fmt::format("{}{} {}", parts.empty() ? "" : ", ", count, name);
  }
  return total == 0 ? std::string("none") : fmt::format("{}: {}", total, parts);
}

std::string triple(Point3d p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z); }

void print_info(const PreparedRender& prepared) {
  const Scene& scene = *prepared.scene;
  const SceneSummary& summary = scene.summary;
  const RenderSettings& s = prepared.settings;
  const auto row = [](const char* name, const std::string& text) { fmt::print("{:<12}{}\n", name, text); };
  row("image",
      fmt::format("{}x{}, {} spp, {} replicates, {}", s.width, s.height, s.spp, s.replicates, s.integrator.model));
  row("shapes", counts_text(summary.shapes));
  row("triangles", summary.instanced_triangles == summary.triangles
                       ? fmt::format("{}", summary.triangles)
                       : fmt::format("{}, with instances {}", summary.triangles, summary.instanced_triangles));
  row("instances", fmt::format("{}", scene.geometry.instances.size()));
  row("materials", counts_text(summary.materials));
  row("lights", counts_text(summary.lights));
  row("textures", counts_text(summary.textures));
  if (summary.bounds.empty())
    row("bounds", "empty");
  else
    row("bounds", fmt::format("{} to {} m", triple(summary.bounds.lo), triple(summary.bounds.hi)));
  fmt::print("memory\n");
  const size_t geometry = scene.geometry_bytes(), accelerator = scene.accelerator->bytes();
  const size_t textures = scene.textures.image_bytes(), lights = scene.light_data.bytes();
  const size_t film = Film::bytes_for(film_settings(s));
  if (scene.textures.cache)
    row("", fmt::format("images of textures in tiles of {}, at most {} in memory", s.textures.cache_folder.string(),
                        bytes_text(scene.textures.cache_limit)));
  for (const auto& [name, bytes] :
       {std::pair("geometry", geometry), std::pair("accelerator", accelerator), std::pair("textures", textures),
        std::pair("lights", lights), std::pair("film", film)})
    fmt::print("  {:<12}{}\n", name, bytes_text(bytes));
  fmt::print("  {:<12}{}\n", "together", bytes_text(geometry + accelerator + textures + lights + film));
}

}  // namespace

void add_info(CLI::App& app, Run& run) {
  auto args = std::make_shared<SceneArguments>();
  CLI::App* command = app.add_subcommand("info", "Show what is in a scene, and the memory it takes.");
  add_scene_options(*command, args);
  add_override_options(*command, args);
  command->footer("Example:\n  etendue info scene.pbrt --size 3840x2160    memory of a larger film");
  command->callback([args, &run] {
    run = [args]() -> int {
      Diagnostics diagnostics(args->allow_unsupported);
      const auto prepared = prepare_render(load_scene(args->scene, diagnostics), args->overrides, diagnostics);
      print_diagnostics(diagnostics);
      if (!prepared) return kBadInput;
      print_info(*prepared);
      return kOk;
    };
  });
}

}  // namespace etd::cli
