// The commands of the program. Each adds its options to the parser and, when the user has chosen it, sets `run`: what
// main() calls once parsing is over, and whose result is the exit code.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace etd::cli {

// 0: done; 1: an internal error, or a verification that failed; 2: something is wrong with what the user gave; 3: done,
// but with invalid samples, which --strict does not tolerate; 128 + the number of a signal: stopped by it.
// `diff` has codes of its own.
enum ExitCode : int { kOk = 0, kInternalError = 1, kFailed = 1, kBadInput = 2, kInvalidSamples = 3, kCannotTell = 3 };

using Run = std::function<int()>;

void add_render(CLI::App& app, Run& run);
void add_tonemap(CLI::App& app, Run& run);
void add_diff(CLI::App& app, Run& run);
void add_replay(CLI::App& app, Run& run);
void add_info(CLI::App& app, Run& run);
void add_check(CLI::App& app, Run& run);
void add_describe(CLI::App& app, Run& run);
void add_verify(CLI::App& app, Run& run);

}  // namespace etd::cli
