// The chapter on the pbrt-v4 language in the manual, generated so that it cannot disagree with the program.
#pragma once

#include <string>

namespace etd {

// Markdown: every model and parameter that is read, from their declarations; and everything of the language that is
// not, with what is rendered instead. docs/formats/pbrt.md is this text.
std::string pbrt_coverage_markdown();

}  // namespace etd
