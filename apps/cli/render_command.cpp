// `etendue render`: a scene goes in, pictures come out.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <set>

#include "arguments.h"
#include "commands.h"
#include "io/file.h"
#include "io/pending_file.h"
#include "loaded_scene.h"
#include "printing.h"
#include "render/duration.h"
#include "render/interrupt.h"
#include "render/memory.h"
#include "render/provenance.h"
#include "render/session.h"
#include "scene/scene.h"
#include "views.h"
#include "watching.h"

namespace etd::cli {
namespace {

struct Arguments : SceneArguments {
  std::vector<std::string> outputs, cameras;
  std::vector<View> views;  // what these two make
  std::string stats;
  bool replicate_layers = false;
  bool strict = false;
  WatchOptions watch;
};

constexpr const char* kExamples =
    "Examples:\n"
    "  etendue render box.pbrt                              as the scene says, to the file it names\n"
    "  etendue render box.pbrt -o box.exr -o box.png        every layer, and a picture to look at\n"
    "  etendue render box.pbrt --size 640x360 --spp 256     another size, and less noise\n"
    "  etendue render box.pbrt --replicates 8               a measured error also for sobol samples\n"
    "  etendue render box.pbrt --set integrator.mode=naive  another estimator of the same image\n"
    "  etendue render box.pbrt --time 1m30s                 as good as it gets in that time\n"
    "  etendue render box.pbrt --error 0.02 --time 1h       until the error is 2 %, one hour at most\n"
    "  etendue render box.pbrt --preview now.png            a picture to look at while it renders\n"
    "  etendue render box.pbrt --camera left.pbrt -o left.exr --camera right.pbrt -o right.exr\n"
    "                                                       two pictures of a scene that is read once\n"
    "\n"
    "--time and --error put the scene's number of samples out of force; --spp still holds. The error is tested\n"
    "at 32, 64, 128 ... samples per pixel, and a render that tests it is labelled biased in its metadata.\n"
    "Ctrl-C finishes what runs, writes the image so far and exits with 130; a second one ends at once.";

int fail(const std::string& message) {
  tell("etendue: {}\n", message);
  return kBadInput;
}

// Why one of these cannot be written; empty when all can. Found before any work is done.
std::string output_problem(const Arguments& args, const std::vector<View>& views) {
  std::vector<std::string> outputs;
  for (const View& view : views) outputs.insert(outputs.end(), view.outputs.begin(), view.outputs.end());
  const auto place = [](const std::string& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(follow_links(path)));
  };
  std::set<std::filesystem::path> places;
  const auto check = [&](const std::string& path, const std::string& problem) -> std::string {
    if (!problem.empty()) return fmt::format("cannot write {}: {}", path, problem);
    if (place(path) == place(args.scene)) return fmt::format("the output {} is the scene itself", path);
    return places.insert(place(path)).second ? std::string() : fmt::format("the output {} is given twice", path);
  };
  std::vector<std::string> images = outputs;
  if (!args.watch.preview.empty()) images.push_back(args.watch.preview);
  for (const std::string& path : images)
    if (std::string problem = check(path, check_output_path(path)); !problem.empty()) return problem;
  if (args.overrides.alpha.value_or(false))
    for (const std::string& path : outputs)
      if (const std::string problem = check_alpha_path(path); !problem.empty())
        return fmt::format("cannot write {} with --alpha: {}", path, problem);
  return args.stats.empty() ? std::string() : check(args.stats, place_problem(args.stats));
}

// Why there are not all the samples that were asked for.
std::string stop_text(const RenderSettings& settings, StoppedBy reason) {
  if (reason == StoppedBy::kSamples) return {};
  return fmt::format("{} ({})", settings.spp_unlimited ? std::string() : fmt::format(" of {}", settings.spp),
                     reason == StoppedBy::kInterrupt ? "interrupted"
                     : reason == StoppedBy::kTime    ? "time is over"
                     : reason == StoppedBy::kMemory  ? "memory is used up"
                                                     : "error reached");
}

void print_summary(const PreparedRender& prepared, const RenderResult& result, const std::string& label) {
  const RenderSettings& s = prepared.settings;
  report("{}{}{}x{}, {}{} spp{}, {:.2f} s, {}rays/s, error {}\n", label, label.empty() ? "" : "  ", s.film.crop.width(),
         s.film.crop.height(), result.spp, result.unequal ? " or more" : "", stop_text(s, result.stopped_by),
         result.seconds,
         short_count(result.seconds > 0 ? static_cast<double>(result.rays.total()) / result.seconds : 0),
         error_text(result.error));
}

void report_empty_pixels(const RenderResult& result) {
  if (result.empty > 0)
    tell("etendue: warning: stopped within the first pass: {:.1f} % of the picture is empty, black without a sample\n",
         100 * result.empty);
}

void report_invalid_samples(const PreparedRender& prepared, const RenderResult& result) {
  const InvalidSamples& invalid = result.invalid;
  if (!invalid.first) return;
  const bool replayable = prepared.settings.traits.replayable;
  tell("etendue: warning: {}{} are invalid ({}) and were taken for black; the image is marked.{}\n", invalid.total(),
       replayable ? fmt::format(" of {} samples", result.rays.camera) : " contributions", invalid_text(invalid),
       replayable ? " The first of them, step by step:\n  " + replay_command(prepared, result, *invalid.first) : "");
}

// What has come of the run so far.
struct Outcome {
  bool failed = false;   // something could not be written or read
  bool invalid = false;  // samples
  size_t rendered = 0;   // views that are done
  std::vector<RenderStats> stats;

  // Says that a file was written, or what went wrong.
  void note(const std::string& path, const std::string& problem) {
    failed = failed || !problem.empty();
    problem.empty() ? report("{}\n", path) : tell("etendue: {}\n", problem);
  }
};

// Writes everything even when one file fails, since an image costs more than a message.
void write_all(const Arguments& args, const View& view, const RowImage& image, Outcome& outcome) {
  for (const std::string& path : view.outputs) {
    const bool alpha = args.overrides.alpha.value_or(false);
    outcome.note(path, write_output(path, image, args.watch.exposure, alpha));
  }
}

// One object, or a list of them where there are several pictures.
void write_stats(const Arguments& args, Outcome& outcome) {
  if (args.stats.empty() || outcome.stats.empty()) return;
  std::string text;
  for (const RenderStats& stats : outcome.stats) text += (text.empty() ? "" : ", ") + stats_json(stats);
  if (args.views.size() > 1) text = fmt::format("[{}]\n", text);
  outcome.note(args.stats, write_file(args.stats, text));
}

// False when it was stopped before there was a picture.
bool render_view(const Arguments& args, const View& view, const std::string& label, PreparedRender& prepared,
                 Watchers& watchers, const std::atomic<bool>& stop, Outcome& outcome) {
  const std::string& shown = label.empty() ? args.scene : view.camera;
  RenderObserver& observer = watchers.begin(std::filesystem::path(shown).filename().string(), label);
  const FinishedRender finished = run_render(prepared, observer, &stop);
  watchers.end_progress();
  if (finished.result.empty == 1) {
    tell("etendue: stopped before any pixel was done, so no picture is written\n");
    return false;
  }
  outcome.stats.push_back(finished_stats(prepared, finished));
  write_all(args, view, finished_rows(prepared, finished, args.replicate_layers), outcome);
  outcome.stats.back().peak_bytes = peak_memory_bytes();
  print_summary(prepared, finished.result, label);
  report_empty_pixels(finished.result);
  report_invalid_samples(prepared, finished.result);
  outcome.invalid = outcome.invalid || finished.result.invalid.total() > 0;
  outcome.failed = outcome.failed || finished.result.stopped_by == StoppedBy::kMemory;
  watchers.end(finished.film);
  const TextureCache* cache = prepared.compiled.scene->textures.cache.get();
  if (!cache || cache->read_error().empty()) return true;
  tell("etendue: the texture cache could not be read, and textures are black where it was not: {}\n",
       cache->read_error());
  outcome.failed = true;
  return true;
}

// Renders one view after the other, until all are done or somebody stops it. False when there are errors.
bool render_views(const Arguments& args, std::vector<View>& views, LoadedScene& scene, Watchers& watchers,
                  std::optional<InterruptScope>& interrupts, Outcome& outcome) {
  const auto stopped = [&] { return outcome.rendered > 0 && interrupts && interrupts->stop(); };
  for (; outcome.rendered < views.size() && !stopped(); ++outcome.rendered) {
    const size_t i = outcome.rendered;
    const std::string name = std::filesystem::path(views[i].camera).filename().string();
    const std::string label = views.size() < 2 ? "" : fmt::format("{}/{} {}", i + 1, views.size(), name);
    try {
      std::optional<PreparedRender> prepared = scene.prepare(i, interrupts ? &interrupts->stop() : nullptr);
      // Until now there was nothing worth keeping, and a signal ended the program at once.
      if (!interrupts) interrupts.emplace();
      if (i == 0) tell_of_refused_threads();
      if (!prepared) return false;
      if (stopped()) break;
      name_output(*prepared, views[i]);
      if (const std::string problem = i == 0 ? output_problem(args, views) : ""; !problem.empty())
        return fail(problem), false;
      if (!render_view(args, views[i], label, *prepared, watchers, interrupts->stop(), outcome)) break;
      outcome.stats.back().load_seconds = i == 0 ? scene.seconds() : 0;
    } catch (const LoadingStopped&) {
      break;
    } catch (const std::exception& e) {
      if (views.size() < 2) throw;
      const bool memory = dynamic_cast<const std::bad_alloc*>(&e) != nullptr;
      tell("etendue: {}: {}\n", label, memory ? "out of memory" : e.what());
      outcome.failed = true;
    }
  }
  return true;
}

int render_scene(const Arguments& args) {
  if (const std::string problem = output_problem(args, args.views); !problem.empty()) return fail(problem);
  Watchers watchers(args.watch);
  if (const std::string problem = watchers.connect(); !problem.empty()) return fail(problem);

  LoadedScene scene(args, args.views, args.watch.quiet);
  std::vector<View> views = args.views;
  if (views.size() > 1) scene.check_views(views);
  std::optional<InterruptScope> interrupts;
  Outcome outcome;
  const bool sound = render_views(args, views, scene, watchers, interrupts, outcome);
  const bool all = outcome.rendered == views.size();
  if (!all && views.size() > 1 && (sound || outcome.rendered > 0))
    tell("etendue: not rendered: {}\n", outputs_text(views, outcome.rendered));
  write_stats(args, outcome);
  if (!sound) return kBadInput;
  if (outcome.failed) return kInternalError;
  if (interrupts && interrupts->exit_code() != 0) return interrupts->exit_code();
  if (!all) return kInternalError;
  return args.strict && outcome.invalid ? kInvalidSamples : kOk;
}

}  // namespace

void add_render(CLI::App& app, Run& run) {
  auto args = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("render", "Render a scene to image files.");
  add_scene_options(*command, args);
  command->remove_option(command->get_option("--camera"));
  CLI::Option* camera =
      command
          ->add_option("--camera", args->cameras,
                       "look at the scene as this file says: a .pbrt file, of which what stands before WorldBegin "
                       "counts; several times for several pictures, each with the outputs behind it")
          ->type_name("FILE")
          ->allow_extra_args(false);
  CLI::Option* output =
      command
          ->add_option(
              "-o,--output", args->outputs,
              "where the picture goes, several times if wanted: .exr holds all layers; .png, .jpg, .hdr and .pfm "
              "the picture (default: what the scene's film names, in the current folder if the film's own does not "
              "exist)")
          ->type_name("FILE")
          ->allow_extra_args(false);
  add_override_options(*command, args);
  command
      ->add_option_function<std::string>(
          "--time",
          [args](const std::string& text) {
            args->overrides.seconds = parse_duration(text);
            if (!args->overrides.seconds)
              throw CLI::ValidationError("--time", "\"" + text + "\" is no time, as in 30s, 2m or 1h30m");
          },
          "stop when rendering has taken this long: 30s, 2m, 1h30m or seconds")
      ->type_name("TIME");
  command
      ->add_option_function<double>(
          "--error", [args](const double& e) { args->overrides.error = e; },
          "stop when the image's relative error is this small, as in 0.02")
      ->type_name("E");
  command->add_option("--exposure", args->watch.exposure, "stops by which .png and .jpg are brighter (0)")
      ->type_name("EV");
  command
      ->add_option("--preview", args->watch.preview,
                   "the picture so far, rewritten every few seconds while it renders: .png, .jpg, .hdr, .pfm or .exr")
      ->type_name("FILE");
  command
      ->add_option("--tev", args->watch.tev, "show the picture so far in the viewer tev, which runs there (port 14158)")
      ->type_name("HOST[:PORT]");
  command
      ->add_option_function<int>(
          "--threads", [args](const int& n) { args->overrides.threads = n; },
          "worker threads (0: all cores); changes the time and nothing else")
      ->type_name("N");
  command
      ->add_option_function<int>(
          "--tile", [args](const int& n) { args->overrides.tile_size = n; },
          "side of a work item in pixels (16); changes the time and nothing else")
      ->type_name("N");
  command->add_option("--stats", args->stats, "write times, rays and memory as JSON")->type_name("FILE");
  command->add_flag("--replicate-layers", args->replicate_layers,
                    "add what each replicate sees to .exr files: layers replicate0, replicate1, ...");
  command->add_flag("--strict", args->strict,
                    "exit with 3 when a sample was NaN, infinite or negative; the image is written all the same");
  command->add_flag("--quiet", args->watch.quiet, "no progress");
  command->footer(kExamples);
  command->callback([args, &run, command, camera, output] {
    args->views = pair_views(*command, camera, args->cameras, output, args->outputs);
    run = [args] { return render_scene(*args); };
  });
}

}  // namespace etd::cli
