// `etendue replay`: one sample of an image again, step by step; or the strongest samples of an image, path by path.
#include <fmt/format.h>

#include <cstdio>

#include "arguments.h"
#include "commands.h"
#include "printing.h"
#include "render/overrides.h"
#include "render/provenance.h"
#include "render/replay.h"
#include "render/version.h"
#include "scene/info.h"

namespace etd::cli {
namespace {

struct Arguments : SceneArguments {
  std::string moved_scene, layer;
  std::optional<std::pair<int, int>> pixel;
  std::optional<uint32_t> sample, fireflies;
  bool verbose = false, json = false;
};

constexpr const char* kExamples =
    "Examples:\n"
    "  etendue replay box.pbrt --pixel 120,88 --sample 471   this path, vertex by vertex\n"
    "  etendue replay box.exr --pixel 120,88 --sample 471    the same, with the options that the image was made with\n"
    "  etendue replay box.exr --fireflies 10                 the ten strongest samples and what they met\n"
    "  etendue replay box.exr --fireflies 3 --verbose        and each of these paths, vertex by vertex\n"
    "\n"
    "A scene needs the same options as the render: --size, --spp, --seed and so on. An image knows them.";

int fail(const std::string& message) {
  tell("etendue: {}\n", message);
  return kBadInput;
}

void warn(const std::string& message) { tell("etendue: warning: {}\n", message); }

// What is to be replayed, once images have been taken for the scenes they show.
struct Task {
  SceneArguments scene;
  std::optional<Provenance> image;
  std::string error;
};

// The scene of an image where the image says it is, or else beside the image.
std::string find_scene(const Provenance& image, const std::string& image_path, std::string& error) {
  const std::filesystem::path beside = std::filesystem::absolute(image_path).parent_path() / image.scene.filename();
  for (const std::filesystem::path& place : {image.scene, beside})
    if (std::filesystem::exists(place)) {
      const std::string whole = place.string(), from_here = std::filesystem::proximate(place).string();
      return from_here.size() < whole.size() ? from_here : whole;
    }
  error = fmt::format("{}: its scene is neither {} nor {}; --scene says where it is now", image_path,
                      image.scene.string(), beside.string());
  return {};
}

// The options that an image keeps, through the same parser as those of a command.
SceneArguments parse_options(const Provenance& image, const std::string& scene) {
  CLI::App app;
  auto args = std::make_shared<SceneArguments>();
  add_scene_options(app, args);
  add_override_options(app, args);
  std::vector<std::string> words(image.options.rbegin(), image.options.rend());  // the parser takes them from the back
  words.insert(words.begin(), scene);
  app.parse(words);
  return *args;
}

// What the image, or the part of it that is meant, says of its render. Nothing where it says nothing.
std::optional<Provenance> find_provenance(const Arguments& args, std::string& error) {
  const PartsResult read = read_parts(args.scene);
  if (!read.error.empty()) return error = fmt::format("{}: {}", args.scene, read.error), std::nullopt;
  std::optional<Provenance> found;
  std::vector<std::string> names;
  bool is_known = args.layer.empty(), differs = false;
  for (const ImagePart& part : read.parts) {
    names.push_back(part.name);
    if (!args.layer.empty() && part.name != args.layer) continue;
    is_known = true;
    std::optional<Provenance> one = read_provenance(part);
    if (!one) continue;
    differs = differs || (found && !(*one == *found));
    if (!found) found = std::move(one);
  }
  if (!is_known)
    error = fmt::format("{}: it has no part \"{}\", but \"{}\"", args.scene, args.layer, fmt::join(names, "\", \""));
  else if (differs)
    error = fmt::format("{}: its parts \"{}\" were rendered in different ways\n  --layer NAME says which one to take",
                        args.scene, fmt::join(names, "\", \""));
  return found;
}

Task make_task(const Arguments& args) {
  Task task;
  if (!is_layered_path(args.scene)) {
    task.scene = args;
    if (!args.layer.empty()) task.error = "--layer is for images of several parts: a scene has none";
    if (!args.moved_scene.empty()) task.error = "--scene is for images: a scene has been given already";
    if (args.fireflies) task.error = "--fireflies takes an image that etendue rendered, as in picture.exr";
    return task;
  }
  task.image = find_provenance(args, task.error);
  if (!task.error.empty()) return task;
  if (!task.image)
    task.error = fmt::format(
        "{}: its metadata do not say how etendue rendered it, so its samples cannot be drawn again", args.scene);
  else if (!sample_options(args.overrides).empty() || args.allow_unsupported || !args.camera.empty())
    task.error = "an image knows the options it was rendered with: others would draw other samples";
  if (!task.error.empty()) return task;
  const std::string scene =
      args.moved_scene.empty() ? find_scene(*task.image, args.scene, task.error) : args.moved_scene;
  if (!task.error.empty()) return task;
  try {
    task.scene = parse_options(*task.image, scene);
  } catch (const CLI::ParseError& e) {
    task.error = fmt::format("{}: its options \"{}\" are unknown to this version: {}", args.scene,
                             fmt::join(task.image->options, " "), e.what());
  }
  return task;
}

// Why there is no such sample; empty when there is.
std::string sample_problem(const SampleId& id, const RenderSettings& s) {
  if (id.x < 0 || id.y < 0 || id.x >= s.film.width || id.y >= s.film.height)
    return fmt::format("pixel {},{} is outside the image of {}x{} pixels, which begins at 0,0", id.x, id.y,
                       s.film.width, s.film.height);
  if (id.number >= s.spp)
    return fmt::format("there is no sample {}: a pixel has {}, from 0 to {} (--spp)", id.number, s.spp, s.spp - 1);
  return {};
}

void print_path(const PathRecord& path, const ReplayedScene& in, bool json) {
  answer("{}{}", json ? replay_json(path, in) : replay_text(path, in), json ? "\n" : "");
}

int replay_one(const SampleId& id, const PreparedRender& prepared, const ReplayedScene& in, bool json) {
  if (const std::string problem = sample_problem(id, prepared.settings); !problem.empty()) return fail(problem);
  PathRecord path;
  if (!prepared.integrator->replay(id, path)) return fail("this integrator has no samples that can be drawn alone");
  print_path(path, in, json);
  return kOk;
}

int replay_fireflies(const Arguments& args, const Provenance& image, const PreparedRender& prepared,
                     const ReplayedScene& in) {
  const size_t count = std::min<size_t>(*args.fireflies, image.strongest.size());
  if (count < *args.fireflies)
    warn(fmt::format("the image remembers {} samples, one of a pixel at most", image.strongest.size()));
  size_t changed = 0;
  std::string details;
  std::vector<std::string> rows;
  for (size_t i = 0; i < count; ++i) {
    const SampleStrength& s = image.strongest[i];
    if (const std::string problem = sample_problem(s.id, prepared.settings); !problem.empty()) return fail(problem);
    PathRecord path;
    if (!prepared.integrator->replay(s.id, path)) return fail("this integrator has no samples that can be drawn alone");
    const bool same = static_cast<float>(received_by_film(path, in).luminance) == s.luminance;
    changed += same ? 0 : 1;
    if (args.json) {
      rows.push_back(fmt::format("{{\"luminance\": {}, \"share\": {}, \"reproduced\": {}, \"path\": {}}}", s.luminance,
                                 s.share, same, replay_json(path, in)));
    } else {
      rows.push_back(fmt::format("{:>3}  {:>11}  {:>8}  {:>10.4g}  {:>6.1f} %  {}{}", i + 1,
                                 fmt::format("{},{}", s.id.x, s.id.y), s.id.number, s.luminance, s.share * 100,
                                 replay_line(path, in), same ? "" : "  (not reproduced)"));
      if (args.verbose) details += "\n" + replay_text(path, in);
    }
  }
  if (args.json)
    answer("[{}]\n", fmt::join(rows, ",\n"));
  else
    answer("{:>3}  {:>11}  {:>8}  {:>10}  {:>8}  path\n{}\n{}", "", "pixel", "sample", "luminance", "of pixel",
           fmt::join(rows, "\n"), details);
  if (changed > 0)
    warn(
        fmt::format("{} of {} samples have other values than in the image: the scene, a file that it uses, or the "
                    "program has changed",
                    changed, count));
  return kOk;
}

int replay(const Arguments& args) {
  if (args.pixel.has_value() != args.sample.has_value()) return fail("--pixel and --sample belong together");
  if (args.pixel.has_value() == args.fireflies.has_value())
    return fail("say what to replay: --pixel X,Y --sample N, or --fireflies N of an image");
  Task task = make_task(args);
  if (!task.error.empty()) return fail(task.error);

  // Limits of this command stand before those that the image keeps.
  for (const std::string& limit : changed_limits(args.limits))
    if (const std::string problem = set_limit(task.scene.limits, limit); !problem.empty()) return fail(problem);
  Diagnostics diagnostics(task.scene.allow_unsupported, task.scene.limits);
  const auto prepared = prepare_render(load_scene(task.scene, diagnostics), task.scene.overrides, diagnostics);
  print_diagnostics(diagnostics);
  if (!prepared) return kBadInput;
  if (task.image && task.image->scene_hash != prepared->scene_hash)
    warn(fmt::format("{} has changed since the image was written: its paths may be others", task.scene.scene));
  if (task.image && task.image->version != version())
    warn(fmt::format("the image is of version {}, this is {}", task.image->version, version()));

  const ReplayedScene in{*prepared->compiled.scene, prepared->compiled.info->names, diagnostics.sources(),
                         prepared->settings.film.sensor};
  if (args.fireflies) return replay_fireflies(args, *task.image, *prepared, in);
  return replay_one({args.pixel->first, args.pixel->second, *args.sample}, *prepared, in, args.json);
}

}  // namespace

void add_replay(CLI::App& app, Run& run) {
  auto args = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("replay", "Draw one sample of an image again, step by step; or explain its fireflies.");
  add_scene_options(*command, args);
  command->get_option("scene")->description("a scene, or an image that etendue rendered (.exr)");
  command
      ->add_option_function<std::string>(
          "--pixel",
          [args](const std::string& text) {
            const auto v = parse_integers(text, ',', 2);
            if (!v) throw CLI::ValidationError("--pixel", "\"" + text + "\" is not X,Y, as in 120,88");
            args->pixel = {(*v)[0], (*v)[1]};
          },
          "in the full image, 0,0 is its upper left corner")
      ->type_name("X,Y");
  command
      ->add_option_function<uint32_t>(
          "--sample", [args](const uint32_t& n) { args->sample = n; }, "which of the pixel's samples, from 0")
      ->type_name("N");
  command
      ->add_option_function<uint32_t>(
          "--fireflies", [args](const uint32_t& n) { args->fireflies = n; },
          "list the N strongest samples of an image (64 are remembered)")
      ->type_name("N");
  command->add_flag("--verbose", args->verbose, "with --fireflies: every path vertex by vertex too");
  command->add_flag("--json", args->json, "for programs: one object, or a list of them");
  command->add_option("--layer", args->layer, "which part of an image that has several renders")->type_name("NAME");
  command->add_option("--scene", args->moved_scene, "where an image's scene is now")->type_name("FILE");
  add_override_options(*command, args);
  command->footer(kExamples);
  command->callback([args, &run] { run = [args] { return replay(*args); }; });
}

}  // namespace etd::cli
