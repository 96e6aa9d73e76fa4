// Sizes of memory as people write them on a command line.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace etd {

// Bytes of "2G", "500M", "64K" or "1.5G", in units of 1024^3, 1024^2 and 1024 (a B may follow); a number alone is
// bytes. Nothing for any other text, and for sizes below one byte.
std::optional<size_t> parse_byte_count(std::string_view text);

}  // namespace etd
