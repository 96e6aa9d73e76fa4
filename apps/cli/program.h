// The command line program: parses arguments, calls the library, prints what it says.
#pragma once

namespace etd::cli {

// All that main() does; returns the exit code. Once a process.
int run_program(int argc, char** argv);

}  // namespace etd::cli
