// What an input may ask for. Whatever can grow faster than the text and the files that ask for it has a limit, so that
// a slip, or a file made to do harm, costs a message and not the machine. A limit is declared once: the option that
// raises it, what messages say of it, and the manual come from that.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace etd {

// Linux has no longer names of files. What stands where a name belongs may be as long as a broken file, and is then not
// worth looking for.
inline constexpr size_t kLongestName = 4096;

struct Limits {
  uint64_t messages = 100;
  uint64_t copies = 1'000'000;
  uint64_t repeated = uint64_t{64} << 20;
  uint64_t unpacked = uint64_t{256} << 20;
  uint64_t corners = 1'000'000;
  uint64_t lookups = 1000;
  uint64_t nesting = 1000;

  // What a packed file of so many bytes may unpack to: honest data are rarely packed a hundredfold.
  uint64_t unpacked_from(uint64_t packed_bytes) const;
};

struct LimitDecl {
  std::string_view name;
  uint64_t Limits::*value;
  uint64_t most;  // that it can be raised to
  bool bytes;     // counts bytes
  std::string_view doc;
};
std::span<const LimitDecl> limit_declarations();

// "1000000", "256M".
std::string limit_value_text(const LimitDecl& decl, uint64_t value);
// "the limit is 1000000; --limit copies=N raises it": the end of every message about a limit.
std::string limit_text(const Limits& limits, uint64_t Limits::*limit);
// Sets one from "copies=2000000" or "unpacked=2G". Returns why the text does not do that, or an empty string.
std::string set_limit(Limits& limits, std::string_view text);
// What set_limit() would take to make these of the limits that nobody has set: "copies=2000000" and so on.
std::vector<std::string> changed_limits(const Limits& limits);
// All of them with their values, for `etendue describe limits`.
std::string describe_limits();

}  // namespace etd
