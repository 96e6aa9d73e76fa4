// `etendue info`: what is in a scene, and the memory it takes; or how an image was made.
#include <fmt/format.h>

#include <map>

#include "arguments.h"
#include "commands.h"
#include "io/file.h"
#include "io/image_codecs.h"
#include "io/picture.h"
#include "printing.h"
#include "render/memory.h"
#include "render/provenance.h"
#include "scene/info.h"
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
  const Scene& scene = *prepared.compiled.scene;
  const SceneSummary& summary = prepared.compiled.info->summary;
  const RenderSettings& s = prepared.settings;
  const auto row = [](const char* name, const std::string& text) { answer("{:<12}{}\n", name, text); };
  row("image", fmt::format("{}x{}, {} spp, {} replicate{}, {}", s.film.width, s.film.height, s.spp,
                           s.film.all_replicates(), s.film.all_replicates() == 1 ? "" : "s", s.integrator.model));
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
  answer("memory\n");
  const size_t geometry = scene.geometry_bytes(), accelerator = scene.accelerator->bytes();
  const size_t textures = scene.textures.image_bytes(), lights = scene.light_data.bytes();
  image_codecs();  // which a render holds in memory too
  const MemoryForecast forecast = forecast_memory(prepared);
  const size_t parts = geometry + accelerator + textures + lights + forecast.film + forecast.integrator;
  if (scene.textures.cache)
    row("", fmt::format("images of textures in tiles of {}, at most {} in memory", s.textures.cache_folder.string(),
                        bytes_text(scene.textures.cache_limit)));
  for (const auto& [name, bytes] :
       {std::pair("geometry", geometry), std::pair("accelerator", accelerator), std::pair("textures", textures),
        std::pair("lights", lights), std::pair("film", forecast.film), std::pair("integrator", forecast.integrator),
        std::pair("program", forecast.peak - std::min(forecast.peak, parts)), std::pair("together", forecast.peak)})
    answer("  {:<12}{}\n", name, bytes_text(bytes));
}

using Entries = std::map<std::string, std::string>;

// What etendue wrote into the metadata of a part.
Entries entries_of(const ImagePart& part, const std::string& path) {
  constexpr std::string_view kOurs = "etendue:";
  Entries entries;
  for (const auto& [name, value] : part.metadata)
    if (name.compare(0, kOurs.size(), kOurs) == 0)
      entries[name.substr(kOurs.size())] = std::visit([](const auto& v) { return fmt::format("{}", v); }, value);
  if (const auto provenance = read_provenance(part))
    entries["strongest"] =
        fmt::format("{} samples remembered (etendue replay {} --fireflies 10)", provenance->strongest.size(), path);
  return entries;
}

void answer_row(std::string_view name, const std::string& text) { answer("{:<26}{}\n", name, text); }

void print_part(const ImagePart& part) {
  answer_row("pixels", fmt::format("{}x{} at {},{} of {}x{}{}", part.width, part.height, part.x, part.y,
                                   part.full_width, part.full_height, part.deep ? ", deep" : ""));
  answer_row("channels", fmt::format("{}", fmt::join(part.channels, " ")));
}

// Which of several parts and layers the other commands take.
void print_choice(const std::vector<ImagePart>& parts) {
  std::vector<PartLayer> layers;
  const LayerChoice choice = choose_picture(parts, layers);
  if (!choice.layer) return answer_row("picture", choice.error + "; --layer NAME says which one to take");
  const PartLayer& l = *choice.layer;
  answer_row("picture", fmt::format("part {}{}{}{}, unless --layer NAME says another", l.part + 1,
                                    l.part_name.empty() ? "" : " " + in_quotes(l.part_name),
                                    l.prefix.empty() ? "" : ", layer ", l.prefix.empty() ? "" : in_quotes(l.prefix)));
}

// What an image knows of itself, and a warning when it is marked.
int print_image_info(const std::string& path) {
  const PartsResult read = read_parts(path);
  if (!read.error.empty()) {
    tell("etendue: {}: {}\n", path, read.error);
    return kBadInput;
  }
  const bool many = read.parts.size() > 1;
  if (many) {
    answer_row("parts", fmt::format("{}", read.parts.size()));
    print_choice(read.parts);
  }
  Entries first;
  std::string invalid_samples;
  for (size_t i = 0; i < read.parts.size(); ++i) {
    const ImagePart& part = read.parts[i];
    if (many) answer_row(fmt::format("part {}", i + 1), part.name.empty() ? "without a name" : in_quotes(part.name));
    print_part(part);
    const Entries entries = entries_of(part, path);
    if (const auto invalid = entries.find("invalid_samples"); invalid != entries.end() && invalid->second != "none")
      invalid_samples = invalid->second;
    if (i > 0 && entries == first) continue;  // programs that split a picture repeat its metadata
    for (const auto& [name, text] : entries) answer_row(name, text);
    if (i == 0) first = entries;
  }
  if (!invalid_samples.empty())
    tell("etendue: warning: {}: samples were invalid ({}) and were taken for black\n", path, invalid_samples);
  return kOk;
}

}  // namespace

void add_info(CLI::App& app, Run& run) {
  auto args = std::make_shared<SceneArguments>();
  CLI::App* command =
      app.add_subcommand("info", "Show what is in a scene, and the memory it takes; or how an image was made.");
  add_scene_options(*command, args);
  add_override_options(*command, args);
  command->footer(
      "Examples:\n"
      "  etendue info scene.pbrt --size 3840x2160    memory of a larger film\n"
      "  etendue info picture.exr                    its parts and channels, and how it was made");
  command->callback([args, &run] {
    run = [args]() -> int {
      if (is_layered_path(args->scene)) return print_image_info(args->scene);
      Diagnostics diagnostics(args->allow_unsupported, args->limits);
      const auto prepared = prepare_render(load_scene(*args, diagnostics), args->overrides, diagnostics);
      print_diagnostics(diagnostics);
      if (!prepared) return kBadInput;
      print_info(*prepared);
      return kOk;
    };
  });
}

}  // namespace etd::cli
