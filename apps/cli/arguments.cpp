#include "arguments.h"
#include "printing.h"

#include <fmt/format.h>

#include <charconv>

#include "contradictions.h"
#include "core/byte_count.h"
#include "formats/foreign.h"
#include "formats/mesh/reader.h"
#include "formats/pbrt/reader.h"
#include "io/gzip.h"
#include "samplers/sampler.h"

namespace etd::cli {
namespace {

template <class T>
void add_value(CLI::App& command, const std::string& name, std::optional<T>& to, const std::string& help,
               const std::string& type) {
  command
      .add_option_function<T>(
          name, [&to](const T& value) { to = value; }, help)
      ->type_name(type);
}

// The names of samplers, that of the default first.
std::string sampler_names() {
  std::string names(SamplerKind().name());
  for (const ModelDecl* decl : sampler_models())
    if (decl->name != SamplerKind().name()) names += " or " + decl->name;
  return names;
}

}  // namespace

std::optional<std::vector<int>> parse_integers(std::string_view text, char separator, size_t count) {
  std::vector<int> values;
  while (true) {
    const size_t end = std::min(text.find(separator), text.size());
    int value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + end, value);
    if (error != std::errc() || stop != text.data() + end) return {};
    values.push_back(value);
    if (end == text.size()) break;
    text.remove_prefix(end + 1);
  }
  if (values.size() != count) return {};
  return values;
}

void add_scene_options(CLI::App& command, const std::shared_ptr<SceneArguments>& args) {
  command
      .add_option("scene", args->scene,
                  "a scene file; its ending names the language: .pbrt (pbrt-v4), or "
                  "a mesh to look at: .obj, .off, .ply")
      ->required()
      ->type_name("SCENE");
  command
      .add_option("--camera", args->camera,
                  "look at the scene as this file says: a .pbrt file, of which what stands before WorldBegin counts")
      ->type_name("FILE");
  command.add_flag("--allow-unsupported", args->allow_unsupported,
                   "replace what is not supported yet by named substitutes, with a warning for each");
  command
      .add_option_function<std::vector<std::string>>(
          "--limit",
          [args](const std::vector<std::string>& texts) {
            for (const std::string& text : texts)
              if (const std::string problem = set_limit(args->limits, text); !problem.empty())
                throw CLI::ValidationError("--limit", problem);
          },
          "raise what a scene may ask for, as in copies=5000000 (etendue describe limits)")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false)
      ->take_all();
}

void add_override_options(CLI::App& command, const std::shared_ptr<SceneArguments>& args) {
  RenderOverrides& o = args->overrides;
  command
      .add_option_function<std::string>(
          "--size",
          [&o](const std::string& text) {
            const auto v = parse_integers(text, 'x', 2);
            if (!v) throw CLI::ValidationError("--size", "\"" + text + "\" is not WIDTHxHEIGHT, as in 640x360");
            o.size = {(*v)[0], (*v)[1]};
          },
          "resolution of the full image, in pixels")
      ->type_name("WxH");
  add_crop_option(command, o.crop, "render only these pixels: x0 <= x < x1, y0 <= y < y1");
  add_value(command, "--spp", o.spp, "samples per pixel, rounded up to a multiple of the replicates", "N");
  add_value(command, "--replicates", o.replicates,
            "independent estimates that the samples are divided into (1); from 4 on their spread gives the error", "R");
  add_value(command, "--seed", o.seed, "another seed gives another estimate; the same one gives the same bits", "N");
  add_value(command, "--sampler", o.sampler, sampler_names() + "; other names as scenes take them", "NAME");
  add_value(command, "--integrator", o.integrator,
            "the algorithm, in place of the scene's: path, light or sppm (etendue describe integrator)", "NAME");
  // Short names for parameters of the integrator.
  const auto shorthand = [&](const std::string& option, const char* key, const char* help, const char* type) {
    command
        .add_option_function<std::string>(
            option, [&o, key](const std::string& text) { o.set.emplace_back(key, text); }, help)
        ->type_name(type);
  };
  for (const Shorthand& s : kShorthands) shorthand(s.option, s.setting, s.help, s.type);
  command
      .add_option_function<std::vector<std::string>>(
          "--set",
          [&o](const std::vector<std::string>& texts) {
            const size_t shorthands = o.set.size();  // the parser takes options in the order in which they are added
            for (const std::string& text : texts) {
              const size_t equals = text.find('=');
              if (equals == std::string::npos)
                throw CLI::ValidationError("--set", "\"" + text + "\" is not NAME=VALUE, as in integrator.maxdepth=8");
              o.set.emplace_back(text.substr(0, equals), text.substr(equals + 1));
            }
            if (const std::string problem = find_contradiction(o, shorthands); !problem.empty())
              throw CLI::ValidationError("options", problem);
          },
          "set any parameter of film, sampler or integrator (etendue describe integrator)")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false)
      ->take_all();
  command
      .add_option_function<std::string>(
          "--texture-memory",
          [&o](const std::string& text) {
            o.texture_memory = parse_byte_count(text);
            if (!o.texture_memory)
              throw CLI::ValidationError("--texture-memory", "\"" + text + "\" is no size, as in 2G or 500M");
          },
          "memory for images of textures (half of the machine's); when they need more, they are read in tiles from a "
          "folder")
      ->type_name("SIZE");
  command
      .add_option_function<std::string>(
          "--texture-cache", [&o](const std::string& text) { o.texture_cache = text; },
          "that folder (~/.cache/etendue/textures)")
      ->type_name("DIR");
  command.add_flag_function(
      "--alpha", [&o](int64_t) { o.alpha = true; },
      "keep what the picture shows without what is behind everything: .png files get an alpha, .exr files the layer "
      "foreground");
  command.add_flag_function(
      "--id-layers", [&o](int64_t) { o.ids = true; },
      "add which object and which material each pixel shows: layers id.object and id.material, named in the metadata");
  command.add_flag_function(
      "--no-features", [&o](int64_t) { o.features = false; }, "leave out albedo, normal, depth and coverage");
}

void add_crop_option(CLI::App& command, std::optional<PixelBounds>& to, const std::string& help) {
  command
      .add_option_function<std::string>(
          "--crop",
          [&to](const std::string& text) {
            const auto v = parse_integers(text, ',', 4);
            if (!v) throw CLI::ValidationError("--crop", "\"" + text + "\" is not x0,x1,y0,y1, as in 100,200,50,80");
            to = PixelBounds{(*v)[0], (*v)[2], (*v)[1], (*v)[3]};
          },
          help)
      ->type_name("x0,x1,y0,y1");
}

SceneDescription load_scene(const std::string& path, Diagnostics& diagnostics) {
  const std::filesystem::path file = path;
  const std::string ending = uncompressed_ending(file);
  if (ending == ".pbrt") return read_pbrt(file, diagnostics);
  if (is_mesh_ending(ending)) return read_mesh_scene(file, diagnostics);
  const std::string_view foreign = foreign_ending(ending);
  diagnostics.error({},
                    fmt::format("{}: the ending \"{}\" names no scene language{}", path, ending,
                                foreign.empty() ? "" : fmt::format(" that is read; it is that of {}", foreign)),
                    "valid: .pbrt (pbrt-v4), and .obj, .off, .ply for a single mesh");
  return {};
}

SceneDescription load_scene(const SceneArguments& args, Diagnostics& diagnostics) {
  SceneDescription description = load_scene(args.scene, diagnostics);
  if (!args.camera.empty())
    static_cast<ViewDescription&>(description) = read_pbrt_view(args.camera, description, diagnostics);
  return description;
}

void print_diagnostics(const Diagnostics& diagnostics) { tell("{}", diagnostics.format_all()); }

}  // namespace etd::cli
