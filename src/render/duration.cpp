#include "render/duration.h"

#include <charconv>
#include <cmath>

namespace etd {

std::optional<double> parse_duration(std::string_view text) {
  constexpr std::string_view kUnits = "hms";
  constexpr double kSeconds[] = {3600, 60, 1};
  double total = 0;
  bool alone = true;
  for (size_t next_unit = 0; !text.empty(); alone = false) {
    double number = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number, std::chars_format::fixed);
    if (error != std::errc() || !(number >= 0) || !std::isfinite(number)) return {};
    const bool bare = stop == end;
    if (bare && !alone) return {};
    const size_t unit = bare ? kUnits.size() - 1 : kUnits.find(*stop, next_unit);
    if (unit == std::string_view::npos) return {};
    total += number * kSeconds[unit];
    next_unit = unit + 1;
    text.remove_prefix(static_cast<size_t>(stop - text.data()) + (bare ? 0 : 1));
  }
  if (!(total > 0) || !std::isfinite(total)) return {};
  return total;
}

}  // namespace etd
