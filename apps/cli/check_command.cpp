// `etendue check`: everything that is wrong with a scene, and nothing rendered.
#include <fmt/format.h>

#include "arguments.h"
#include "commands.h"
#include "printing.h"
#include "render/session.h"

namespace etd::cli {

void add_check(CLI::App& app, Run& run) {
  auto args = std::make_shared<SceneArguments>();
  CLI::App* command = app.add_subcommand("check", "Find every problem in a scene without rendering it.");
  add_scene_options(*command, args);
  command->footer("Exits with 0 when the scene can be rendered, and with 2 when it has problems.");
  command->callback([args, &run] {
    run = [args]() -> int {
      Diagnostics diagnostics(args->allow_unsupported, args->limits);
      const auto prepared = prepare_render(load_scene(*args, diagnostics), args->overrides, diagnostics);
      print_diagnostics(diagnostics);
      if (!prepared) return kBadInput;
      answer("{}: no problems\n", args->scene);
      return kOk;
    };
  });
}

}  // namespace etd::cli
