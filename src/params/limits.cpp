#include "params/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <optional>

#include "core/byte_count.h"

namespace etd {

namespace {

constexpr uint64_t kAny = uint64_t{1} << 60;

constexpr LimitDecl kLimits[] = {
    {"messages", &Limits::messages, kAny, false,
     "Errors, warnings and notes that are shown, each kind by itself; the others are counted."},
    {"copies", &Limits::copies, kAny, false,
     "Shapes and instances that instances of instances make, beyond those that the scene lists."},
    {"repeated", &Limits::repeated, kAny, true,
     "Text and numbers that stand once and are used again: files included twice, defaults of Attribute, files of "
     "spectra."},
    {"unpacked", &Limits::unpacked, kAny, true,
     "What a compressed file, or an image, may unpack to; a hundred times its size where that is more."},
    {"corners", &Limits::corners, uint64_t{1} << 30, false, "Corners of one polygon of a mesh file."},
    {"lookups", &Limits::lookups, kAny, false, "Textures that one lookup asks, through textures made of textures."},
    // Each level takes room on the stack of a thread.
    {"nesting", &Limits::nesting, 10'000, false,
     "Levels of objects, textures or mixed materials that are made of each other."}};

const LimitDecl& declaration(uint64_t Limits::*limit) {
  return *std::find_if(std::begin(kLimits), std::end(kLimits), [&](const LimitDecl& d) { return d.value == limit; });
}

std::string_view value_word(const LimitDecl& decl) { return decl.bytes ? "SIZE" : "N"; }

std::optional<uint64_t> parse_value(const LimitDecl& decl, std::string_view text) {
  if (decl.bytes) return parse_byte_count(text);
  uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value == 0) return {};
  return value;
}

}  // namespace

uint64_t Limits::unpacked_from(uint64_t packed_bytes) const {
  constexpr uint64_t kRatio = 100;
  return std::max(unpacked, kRatio * packed_bytes);
}

std::span<const LimitDecl> limit_declarations() { return kLimits; }

std::string limit_value_text(const LimitDecl& decl, uint64_t value) {
  if (!decl.bytes) return fmt::format("{}", value);
  constexpr std::string_view kUnits[] = {"", "K", "M", "G", "T"};
  size_t unit = 0;
  for (; value % 1024 == 0 && value > 0 && unit + 1 < std::size(kUnits); ++unit) value /= 1024;
  return fmt::format("{}{}", value, kUnits[unit]);
}

std::string limit_text(const Limits& limits, uint64_t Limits::*limit) {
  const LimitDecl& decl = declaration(limit);
  return fmt::format("the limit is {}; --limit {}={} raises it", limit_value_text(decl, limits.*limit), decl.name,
                     value_word(decl));
}

std::string set_limit(Limits& limits, std::string_view text) {
  const size_t equals = std::min(text.find('='), text.size());
  const std::string_view name = text.substr(0, equals);
  const auto* decl =
      std::find_if(std::begin(kLimits), std::end(kLimits), [&](const LimitDecl& d) { return d.name == name; });
  if (decl == std::end(kLimits)) {
    std::string valid;
    for (const LimitDecl& d : kLimits)
      valid += fmt::format("{}{}={}", valid.empty() ? "" : ", ", d.name, value_word(d));
    return fmt::format("\"{}\" sets no limit; valid: {}", text, valid);
  }
  const auto value = parse_value(*decl, text.substr(std::min(equals + 1, text.size())));
  if (!value || *value > decl->most)
    return fmt::format("\"{}\" is no value for \"{}\"; valid: {}", text.substr(std::min(equals + 1, text.size())), name,
                       decl->bytes ? std::string("sizes such as 500M or 2G") : fmt::format("1 to {}", decl->most));
  limits.*(decl->value) = *value;
  return {};
}

std::vector<std::string> changed_limits(const Limits& limits) {
  std::vector<std::string> texts;
  for (const LimitDecl& d : kLimits)
    if (limits.*(d.value) != Limits().*(d.value))
      texts.push_back(fmt::format("{}={}", d.name, limit_value_text(d, limits.*(d.value))));
  return texts;
}

std::string describe_limits() {
  std::string text;
  for (const LimitDecl& d : kLimits)
    text += fmt::format("{:10}{:>8}  {}\n", d.name, limit_value_text(d, Limits().*(d.value)), d.doc);
  return text;
}

}  // namespace etd
