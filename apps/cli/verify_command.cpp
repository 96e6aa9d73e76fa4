// `etendue verify`: the renderer, one of its models, or a user's scene shown right or wrong.
#include <fmt/format.h>

#include <charconv>
#include <set>

#include "arguments.h"
#include "commands.h"
#include "printing.h"
#include "render/duration.h"
#include "render/interrupt.h"
#include "task_bar.h"
#include "verify/battery/run.h"
#include "verify/scene/verify_scene.h"

namespace etd::cli {
namespace {

struct ModelArguments {
  std::string family, model, folder;
  std::optional<double> samples;
  uint64_t seed = 1;
  int threads = 0;
  bool json = false, quiet = false;
};

struct VerifySceneArguments {
  std::shared_ptr<SceneArguments> scene = std::make_shared<SceneArguments>();
  std::optional<double> seconds;
  std::string folder;
  bool json = false, quiet = false;
};

// A run of one model takes this many times the samples that it gets in a run of all of them.
constexpr double kSamplesOfOne = 4;

int unknown(const std::string& what, const std::string& word, const std::set<std::string>& valid) {
  const std::vector<std::string_view> names(valid.begin(), valid.end());
  tell("etendue: no {} \"{}\" is verified\n", what, word);
  if (const std::string_view near = nearest_name(word, names); !near.empty()) tell("  did you mean \"{}\"?\n", near);
  tell("  valid: {}\n", fmt::join(names, ", "));
  return kBadInput;
}

int verify_models(const ModelArguments& args) {
  std::vector<BatterySubject> subjects;
  std::set<std::string> families, models;
  for (BatterySubject& s : battery_subjects()) {
    families.insert(s.family);
    if (!args.family.empty() && s.family != args.family) continue;
    models.insert(s.model);
    if (args.model.empty() || s.model == args.model) subjects.push_back(std::move(s));
  }
  if (models.empty()) {
    families.insert("scene");
    return unknown("family of models", args.family, families);
  }
  if (subjects.empty()) return unknown(args.family, args.model, models);

  BatteryOptions options;
  options.samples = args.samples.value_or(args.model.empty() ? 1 : kSamplesOfOne);
  options.seed = args.seed;
  options.family_level = 1e-4;
  const InterruptScope interrupts;
  TaskBar bar(args.quiet);
  const BatteryRun run = run_battery(
      subjects, options, args.threads,
      [&](size_t done, size_t all, const std::string& name) {
        bar.show(static_cast<double>(done) / static_cast<double>(all), name);
      },
      interrupts.stop());
  bar.clear();
  answer("{}", args.json ? battery_json(run) : battery_table(run, !args.model.empty()));

  if (!args.folder.empty()) {
    std::string problem;
    for (const auto& file : write_check_pictures(run, args.folder, !args.model.empty(), problem))
      if (!args.json) answer("{}\n", file.string());
    if (!problem.empty()) {
      tell("etendue: {}\n", problem);
      return kBadInput;
    }
  } else if (!run.passed() && !args.json) {
    answer("pictures of what differs: the same command with -o FOLDER\n");
  }
  if (interrupts.exit_code() != 0) return interrupts.exit_code();
  return run.passed() ? kOk : kFailed;
}

int verify_user_scene(const VerifySceneArguments& args) {
  const RenderOverrides& o = args.scene->overrides;
  SceneVerifyOptions options;
  options.size = o.size;
  options.spp = o.spp.value_or(options.spp);
  options.seconds = args.seconds;
  options.seed = o.seed.value_or(options.seed);
  options.threads = o.threads.value_or(0);
  options.set = o.set;
  Diagnostics diagnostics(args.scene->allow_unsupported, args.scene->limits);
  const SceneDescription description = load_scene(*args.scene, diagnostics);
  const InterruptScope interrupts;
  TaskBar bar(args.quiet);
  const auto v = verify_scene(
      description, options, diagnostics, [&](double share, const std::string& what) { bar.show(share, what); },
      interrupts.stop());
  bar.clear();
  print_diagnostics(diagnostics);
  if (!v) return kBadInput;
  if (args.json) {
    answer("{}", scene_json(*v));
  } else {
    answer("{}x{}\n{}", v->width, v->height, scene_table(*v));
  }
  if (!args.folder.empty()) {
    std::error_code failed;
    std::filesystem::create_directories(args.folder, failed);
    for (const EstimatorReport& e : v->estimators) {
      if (!e.map) continue;
      std::string name = e.name;
      std::replace(name.begin(), name.end(), ' ', '-');
      const std::filesystem::path path = std::filesystem::path(args.folder) / (name + ".png");
      if (const std::string problem = write_check_map(path, *e.map); !problem.empty()) {
        tell("etendue: {}\n", problem);
        return kBadInput;
      }
      if (!args.json) answer("{}\n", path.string());
    }
  }
  if (interrupts.exit_code() != 0) return interrupts.exit_code();
  return v->disagrees() ? kFailed : v->cannot_tell() ? kCannotTell : kOk;
}

CLI::Option* add_seconds(CLI::App& command, std::optional<double>& to) {
  return command
      .add_option_function<std::string>(
          "--time",
          [&to](const std::string& text) {
            to = parse_duration(text);
            if (!to) throw CLI::ValidationError("--time", "\"" + text + "\" is no time, as in 30s, 2m or 1h30m");
          },
          "for all estimators together, instead of a number of samples: 30s, 2m, 1h30m or seconds")
      ->type_name("TIME");
}

CLI::App* add_scene_command(CLI::App& command, const std::shared_ptr<VerifySceneArguments>& args) {
  CLI::App* scene = command.add_subcommand("scene", "Render a scene by every estimator that applies: do they agree?");
  add_scene_options(*scene, args->scene);
  add_override_options(*scene, args->scene);
  for (const char* name :
       {"--crop", "--replicates", "--sampler", "--mode", "--components", "--alpha", "--id-layers", "--no-features"})
    scene->remove_option(scene->get_option(name));
  scene->get_option("--size")->description("resolution in pixels (the scene's, until no side is over 64)");
  scene->get_option("--spp")->description("samples per pixel of each estimator (256)");
  add_seconds(*scene, args->seconds)->excludes("--spp");
  scene->add_option("-o,--output", args->folder, "where pictures of what disagrees go")->type_name("FOLDER");
  scene->add_flag("--json", args->json, "the result as JSON");
  scene->add_flag("--quiet", args->quiet, "no progress");
  scene->footer(
      "Each estimator of the path tracer is compared with its usual way (mis, sobol) by Welch tests of the whole "
      "image\n"
      "and of blocks of 8x8 pixels, which raise a false alarm in one of 10000 scenes. What disagrees is rendered "
      "again\n"
      "with four times the samples before it is said. \"cannot tell\" means that the estimator is too noisy here, or "
      "that\n"
      "it rests on rare bright samples of which too few were met: more samples (--spp, --time) may decide.\n"
      "\n"
      "Exits with 0 when nothing disagrees, with 1 when something does, with 2 when the scene has problems.");
  return scene;
}

}  // namespace

void add_verify(CLI::App& app, Run& run) {
  auto models = std::make_shared<ModelArguments>();
  auto scene = std::make_shared<VerifySceneArguments>();
  CLI::App* command =
      app.add_subcommand("verify", "Test every model against its own promises, or a scene by several estimators.");
  command->add_option("family", models->family,
                      "material, bsdf, light, phase, sampler, camera, filter, texture, warp ...");
  command->add_option("model", models->model, "a model of this family, verified with more samples");
  command
      ->add_option_function<std::string>(
          "--samples",
          [models](const std::string& text) {
            double factor = 0;
            const char* end = text.data() + text.size();
            const auto [stop, error] = std::from_chars(text.data(), end, factor);
            const bool rest = stop == end || (stop + 1 == end && *stop == 'x');
            if (error != std::errc() || !rest || !(factor >= 0.01 && factor <= 1e4))
              throw CLI::ValidationError("--samples", "\"" + text + "\" is no factor from 0.01 to 10000, as in 4x");
            models->samples = factor;
          },
          "factor on the usual numbers of samples, as in 4x (1x, of one model 4x)")
      ->type_name("FACTOR");
  command->add_option("--seed", models->seed, "other random numbers; every seed must pass (1)")->type_name("N");
  command->add_option("--threads", models->threads, "worker threads (0: all cores)")->type_name("N");
  command
      ->add_option("-o,--output", models->folder,
                   "where pictures of histograms go: sampled, expected, difference; of what fails, or of one model all")
      ->type_name("FOLDER");
  command->add_flag("--json", models->json, "the result as JSON");
  command->add_flag("--quiet", models->quiet, "no progress");
  CLI::App* scene_command = add_scene_command(*command, scene);
  command->footer(
      "Examples:\n"
      "  etendue verify                                         everything; a row for each model\n"
      "  etendue verify light                                   one family\n"
      "  etendue verify material conductor --samples 16x -o out pictures of the histograms of one model\n"
      "  etendue verify scene my.pbrt --time 2m                 do all estimators give the same image?\n"
      "\n"
      "Statistical checks raise a false alarm in one of 10000 runs; what fails is run again with four times the "
      "samples\n"
      "before it counts. `deviation` is the largest of the other checks, as a share of what rounding may cause.\n"
      "Exits with 0 when everything passes, with 1 when something fails, with 2 when the command line has errors.");
  command->callback([models, scene, scene_command, &run] {
    if (scene_command->parsed())
      run = [scene] { return verify_user_scene(*scene); };
    else
      run = [models] { return verify_models(*models); };
  });
}

}  // namespace etd::cli
