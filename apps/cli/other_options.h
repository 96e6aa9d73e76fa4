// What to tell somebody who writes an option that is not ours: of another renderer, of another command, or misspelt.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace etd::cli {

// A message for each word that begins like an option and is none of the command's, with what was meant; or one for a
// picture's name that stands where it is not expected; empty when there is neither. `words` are those behind the
// command's name, which the parser has refused.
std::string unknown_options(const CLI::App& command, const std::vector<std::string>& words);

}  // namespace etd::cli
