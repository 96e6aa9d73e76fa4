#include "program.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <new>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "commands.h"
#include "other_options.h"
#include "params/diagnostics.h"
#include "printing.h"
#include "render/interrupt.h"
#include "render/version.h"

namespace etd::cli {
namespace {

constexpr const char* kExamples = R"(Examples:
  etendue render cornell-box.pbrt                        the picture that the scene's film names, in this folder
  etendue render scene.pbrt -o out.exr -o out.png        all layers as EXR, and a PNG to look at
  etendue render scene.pbrt --size 640x360 --spp 64      smaller, and 64 samples per pixel
  etendue tonemap out.exr out.jpg --operator filmic      another picture of what was rendered
  etendue diff a.exr b.exr                               how two images differ, and whether more than noise does
  etendue replay out.exr --fireflies 10                  the strongest samples of an image, path by path
  etendue check scene.pbrt                               everything that is wrong with a scene
  etendue describe material conductor                    its parameters
  etendue verify                                         every model against its own promises

`etendue COMMAND --help` tells more about a command.)";

// CLI11 takes a mistyped command for a missing one; this says which word was wrong. False when there is none.
bool report_unknown_command(const CLI::App& app, const char* word) {
  if (word == nullptr || word[0] == '-') return false;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), word) != names.end()) return false;
  const std::vector<std::string_view> views(names.begin(), names.end());
  const std::string_view near = nearest_name(word, views);
  tell("etendue: there is no command \"{}\"\n", word);
  std::error_code ignored;
  if (std::filesystem::exists(word, ignored))
    tell("  did you mean \"etendue render {}\"?\n", word);
  else if (!near.empty())
    tell("  did you mean \"{}\"?\n", near);
  tell("  valid: {}\n", fmt::join(names, ", "));
  return true;
}

// What is wrong with the options, in words that help more than the parser's; empty when it is something else.
std::string wrong_options(const CLI::App& app, int argc, char** argv) {
  const CLI::App* command = &app;
  int i = 1;
  for (; i < argc; ++i) {
    const auto named = [&](const CLI::App* c) { return c->get_name() == argv[i]; };
    const std::vector<const CLI::App*> found = command->get_subcommands(named);
    if (found.empty()) break;
    command = found[0];
  }
  // Without a command, the options are those of a render.
  std::string text;
  if (command == &app) {
    text = "etendue: a command comes first, as in `etendue render SCENE`\n";
    command = app.get_subcommand("render");
  }
  const std::string unknown = unknown_options(*command, {argv + i, argv + argc});
  return unknown.empty() ? unknown : text + unknown;
}

// An empty text is no file, name or number: mostly it is a variable of a script that was never set.
void refuse_empty_values(CLI::App& app) {
  for (CLI::Option* option : app.get_options())
    option->check([](const std::string& value) { return value.empty() ? "the value is empty" : ""; });
  for (CLI::App* command : app.get_subcommands(nullptr)) refuse_empty_values(*command);
}

// Help was asked for, or something is wrong with the arguments.
int say_parse_result(const CLI::App& app, const CLI::ParseError& result) {
  std::ostringstream help, problem;
  if (app.exit(result, help, problem) == 0) {
    answer("{}", help.str());
    return code_after_answers(kOk, kInternalError);
  }
  tell("{}", problem.str());
  return kBadInput;
}

}  // namespace

int run_program(int argc, char** argv) {
  prepare_standard_streams();
  const EndOnSignal ending;  // before any work: a signal is answered in words
  CLI::App app{"Etendue, a reference renderer for Monte Carlo light transport.", "etendue"};
  app.set_version_flag("--version", std::string("etendue ") + version());
  app.require_subcommand(1);
  app.footer(kExamples);
  Run run;
  add_render(app, run);
  add_tonemap(app, run);
  add_diff(app, run);
  add_replay(app, run);
  add_info(app, run);
  add_check(app, run);
  add_describe(app, run);
  add_verify(app, run);
  refuse_empty_values(app);
  if (report_unknown_command(app, argc > 1 ? argv[1] : nullptr)) return kBadInput;
  try {
    app.parse(argc, argv);
    const int code = run();
    tell_of_refused_threads();
    return code_after_answers(code, kInternalError);
  } catch (const CLI::ParseError& e) {
    const std::string unknown = e.get_exit_code() == 0 ? std::string() : wrong_options(app, argc, argv);
    if (unknown.empty()) return say_parse_result(app, e);
    tell("{}", unknown);
    return kBadInput;
  } catch (const std::bad_alloc&) {
    tell("etendue: out of memory; `etendue info SCENE` says how much a render takes\n");
  } catch (const std::exception& e) {
    tell("etendue: internal error: {}\n", e.what());
  }
  return kInternalError;
}

}  // namespace etd::cli
