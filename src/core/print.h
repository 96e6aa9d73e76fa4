// Messages that may be lost: a log on a full disk or a terminal that was closed must not cost what the program is for.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

namespace etd {

// Prints like fmt::print, but drops what cannot be written, where that one throws.
template <class... Args>
void print_or_drop(std::FILE* to, fmt::format_string<Args...> format, Args&&... args) {
  const std::string text = fmt::format(format, std::forward<Args>(args)...);
  std::fwrite(text.data(), 1, text.size(), to);
}

}  // namespace etd
