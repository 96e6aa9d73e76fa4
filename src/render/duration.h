// Spans of time as people write them on a command line.
#pragma once

#include <optional>
#include <string_view>

namespace etd {

// Seconds of "90", "30s", "2m", "1.5h" or "1h30m": numbers with the units h, m and s, each at most once and in this
// order; a number alone is seconds. Nothing for any other text, and for spans that are not positive.
std::optional<double> parse_duration(std::string_view text);

}  // namespace etd
