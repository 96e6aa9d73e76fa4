#include "core/byte_count.h"

#include <charconv>

namespace etd {

std::optional<size_t> parse_byte_count(std::string_view text) {
  double number = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number, std::chars_format::fixed);
  if (error != std::errc()) return {};
  std::string_view unit(stop, static_cast<size_t>(end - stop));
  constexpr std::string_view kUnits = "KMGT";
  if (!unit.empty()) {
    const size_t power = kUnits.find(unit[0]);
    if (power == std::string_view::npos || (unit.size() > 1 && unit.substr(1) != "B")) return {};
    for (size_t i = 0; i <= power; ++i) number *= 1024;
  }
  if (!(number >= 1) || !(number < 0x1p60)) return {};
  return static_cast<size_t>(number);
}

}  // namespace etd
