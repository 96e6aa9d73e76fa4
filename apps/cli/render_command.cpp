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
#include "printing.h"
#include "render/duration.h"
#include "render/interrupt.h"
#include "render/memory.h"
#include "render/provenance.h"
#include "render/session.h"
#include "scene/scene.h"
#include "watching.h"

namespace etd::cli {
namespace {

struct Arguments : SceneArguments {
  std::vector<std::string> outputs;
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
    "\n"
    "--time and --error put the scene's number of samples out of force; --spp still holds. The error is tested\n"
    "at 32, 64, 128 ... samples per pixel, and a render that tests it is labelled biased in its metadata.\n"
    "Ctrl-C finishes what runs, writes the image so far and exits with 130; a second one ends at once.";

int fail(const std::string& message) {
  tell("etendue: {}\n", message);
  return kBadInput;
}

// Why one of these cannot be written; empty when all can. Found before any work is done.
std::string output_problem(const std::vector<std::string>& outputs, const Arguments& args) {
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
  return args.stats.empty() ? std::string() : check(args.stats, place_problem(args.stats));
}

// Where the picture goes that the scene's film names, with either kind of slash: there if its folder exists, seen from
// the current one, and otherwise into the current one.
std::string output_of_film(std::string filename) {
  std::replace(filename.begin(), filename.end(), '\\', '/');
  const std::filesystem::path wanted = filename;
  std::error_code ignored;
  return std::filesystem::is_directory(wanted.parent_path(), ignored) ? filename : wanted.filename().string();
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

void print_summary(const PreparedRender& prepared, const RenderResult& result) {
  const RenderSettings& s = prepared.settings;
  report("{}x{}, {}{} spp{}, {:.2f} s, {}rays/s, error {}\n", s.crop.width(), s.crop.height(), result.spp,
         result.unequal ? " or more" : "", stop_text(s, result.stopped_by), result.seconds,
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
  tell(
      "etendue: warning: {} of {} samples are invalid ({}) and were taken for black; the image is marked. The "
      "first of them, step by step:\n  {}\n",
      invalid.total(), result.rays.camera, invalid_text(invalid), replay_command(prepared, result, *invalid.first));
}

// Writes everything even when one file fails, since an image costs more than a message.
bool write_all(const Arguments& args, const std::vector<std::string>& outputs, const RowImage& image,
               RenderStats stats) {
  bool ok = true;
  const auto note = [&ok](const std::string& path, const std::string& problem) {
    ok = ok && problem.empty();
    problem.empty() ? report("{}\n", path) : tell("etendue: {}\n", problem);
  };
  for (const std::string& path : outputs) note(path, write_output(path, image, args.watch.exposure));
  stats.peak_bytes = peak_memory_bytes();
  if (!args.stats.empty()) note(args.stats, write_file(args.stats, stats_json(stats)));
  return ok;
}

int render_scene(const Arguments& args) {
  if (const std::string problem = output_problem(args.outputs, args); !problem.empty()) return fail(problem);
  Watchers watchers(args.watch);
  if (const std::string problem = watchers.connect(); !problem.empty()) return fail(problem);

  const auto start = std::chrono::steady_clock::now();
  Diagnostics diagnostics(args.allow_unsupported);
  std::optional<PreparedRender> prepared;
  double load_seconds = 0;
  {
    const SceneDescription description = load_scene(args.scene, diagnostics);
    load_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    prepared = prepare_render(description, args.overrides, diagnostics);
  }
  print_diagnostics(diagnostics);
  tell_of_refused_threads();
  if (!prepared) return kBadInput;

  std::vector<std::string> outputs = args.outputs;
  if (outputs.empty()) {
    outputs.push_back(output_of_film(prepared->settings.filename));
    if (const std::string problem = output_problem(outputs, args); !problem.empty()) return fail(problem);
  }

  const InterruptScope interrupts;
  RenderObserver& observer = watchers.begin(std::filesystem::path(args.scene).filename().string());
  const FinishedRender finished = run_render(*prepared, observer, &interrupts.stop());
  watchers.end_progress();
  if (finished.result.empty == 1) {
    tell("etendue: stopped before any pixel was done, so no picture is written\n");
    return interrupts.exit_code() != 0 ? interrupts.exit_code() : kInternalError;
  }
  RenderStats stats = finished_stats(*prepared, finished);
  stats.load_seconds = load_seconds;
  const bool written = write_all(args, outputs, finished_rows(*prepared, finished, args.replicate_layers), stats);
  print_summary(*prepared, finished.result);
  report_empty_pixels(finished.result);
  report_invalid_samples(*prepared, finished.result);
  watchers.end(finished.film);
  const TextureCache* cache = prepared->scene->textures.cache.get();
  if (cache && !cache->read_error().empty()) {
    tell("etendue: the texture cache could not be read, and textures are black where it was not: {}\n",
         cache->read_error());
    return kInternalError;
  }
  if (!written || finished.result.stopped_by == StoppedBy::kMemory) return kInternalError;
  if (interrupts.exit_code() != 0) return interrupts.exit_code();
  return args.strict && finished.result.invalid.total() > 0 ? kInvalidSamples : kOk;
}

}  // namespace

void add_render(CLI::App& app, Run& run) {
  auto args = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("render", "Render a scene to image files.");
  add_scene_options(*command, args);
  command
      ->add_option(
          "-o,--output", args->outputs,
          "where the picture goes, several times if wanted: .exr holds all layers; .png, .jpg, .hdr and .pfm "
          "the picture (default: what the scene's film names, in the current folder if the film's own does not exist)")
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
  command->callback([args, &run] { run = [args] { return render_scene(*args); }; });
}

}  // namespace etd::cli
