// The header of a PLY file: which elements with which properties follow, and in which encoding.
// Format: Greg Turk, "The PLY Polygon File Format", 1994, and the sized type names (int8 ... float64) added since.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/problem_list.h"

namespace etd {

enum class PlyEncoding { kAscii, kBinaryLittleEndian, kBinaryBigEndian };
enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

constexpr uint64_t ply_type_bytes(PlyType type) {
  constexpr uint64_t kBytes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kBytes[static_cast<int>(type)];
}
// The value of an integer type that has all bits set: -1, or what -1 becomes in an unsigned type.
constexpr double ply_all_bits(PlyType type) {
  const bool is_unsigned = type == PlyType::kUint8 || type == PlyType::kUint16 || type == PlyType::kUint32;
  return is_unsigned ? static_cast<double>((uint64_t{1} << (8 * ply_type_bytes(type))) - 1) : -1.0;
}
constexpr bool is_floating(PlyType type) { return type == PlyType::kFloat32 || type == PlyType::kFloat64; }

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat32;   // of the value, or of each value of a list
  std::optional<PlyType> count_type;  // present: the property is a list that starts with its length
};

struct PlyElement {
  std::string name;
  uint64_t count = 0;
  int line = 0;  // of its declaration
  std::vector<PlyProperty> properties;

  const PlyProperty* find(std::string_view property) const;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::kAscii;
  std::vector<PlyElement> elements;
  size_t data_offset = 0;  // first byte after the header
  int data_line = 1;       // its line, counted from 1
  char line_end = '\n';    // '\r' in files of old Macs; "\r\n" ends at '\n' too

  const PlyElement* find(std::string_view element) const;
};

// The next line of `text` from `offset`, which moves behind it; without its end, whether that is LF, CRLF or
// `line_end`.
std::string_view next_ply_line(std::string_view text, size_t& offset, char line_end);

// Reads the header at the start of `file`. Adds every problem found ("line 3: ...") and then returns nothing.
std::optional<PlyHeader> read_ply_header(std::string_view file, ProblemList& problems);

}  // namespace etd
