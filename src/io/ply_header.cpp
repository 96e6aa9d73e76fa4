#include "io/ply_header.h"

#include <algorithm>
#include <charconv>
#include <set>

#include "io/file.h"

namespace etd {
namespace {

struct TypeName {
  std::string_view name;
  PlyType type;
};
constexpr TypeName kTypeNames[] = {
    {"char", PlyType::kInt8},       {"uchar", PlyType::kUint8},    {"short", PlyType::kInt16},
    {"ushort", PlyType::kUint16},   {"int", PlyType::kInt32},      {"uint", PlyType::kUint32},
    {"float", PlyType::kFloat32},   {"double", PlyType::kFloat64}, {"int8", PlyType::kInt8},
    {"uint8", PlyType::kUint8},     {"int16", PlyType::kInt16},    {"uint16", PlyType::kUint16},
    {"int32", PlyType::kInt32},     {"uint32", PlyType::kUint32},  {"float32", PlyType::kFloat32},
    {"float64", PlyType::kFloat64},
};

std::optional<PlyType> type_named(std::string_view name) {
  for (const TypeName& known : kTypeNames) {
    if (known.name == name) return known.type;
  }
  return std::nullopt;
}

std::vector<std::string_view> split_words(std::string_view line) {
  std::vector<std::string_view> words;
  for (size_t at = 0;;) {
    const size_t begin = line.find_first_not_of(" \t", at);
    if (begin == std::string_view::npos) return words;
    at = std::min(line.find_first_of(" \t", begin), line.size());
    words.push_back(line.substr(begin, at - begin));
  }
}

// Goes through the header line by line; each handler reports what is wrong with its line and reading goes on.
class HeaderReader {
 public:
  HeaderReader(std::string_view file, ProblemList& problems) : file_(file), problems_(problems) {}

  std::optional<PlyHeader> read();

 private:
  using Words = std::vector<std::string_view>;

  void wrong(std::string what) {
    problems_.add(fmt::format("line {}: {}", line_, what));
    good_ = false;
  }
  bool read_lines();
  void read_format(const Words& words);
  void read_element(const Words& words);
  void read_property(const Words& words);

  std::string_view file_;
  ProblemList& problems_;
  PlyHeader header_;
  int line_ = 1;
  bool good_ = true;
  bool has_format_ = false;
  std::set<std::string_view> elements_, properties_;  // names; the latter of the element read last
};

std::optional<PlyHeader> HeaderReader::read() {
  if (file_.empty()) {
    problems_.add("the file is empty");
    return std::nullopt;
  }
  const size_t first_end = file_.find_first_of("\r\n");
  const size_t magic_end = file_.substr(0, first_end).find_last_not_of(" \t");
  if (file_.substr(0, magic_end == std::string_view::npos ? 0 : magic_end + 1) != "ply") {
    problems_.add("line 1: not a PLY file, its first line must be \"ply\"");
    return std::nullopt;
  }
  if (first_end != std::string_view::npos && file_[first_end] == '\r' && file_.substr(first_end + 1, 1) != "\n") {
    header_.line_end = '\r';
  }
  if (!read_lines()) return std::nullopt;
  if (!has_format_) wrong("the header has no \"format\" line");
  if (!good_) return std::nullopt;
  header_.data_line = line_ + 1;
  return std::move(header_);
}

// Returns false where the header was lost; true at its end.
bool HeaderReader::read_lines() {
  size_t& offset = header_.data_offset;
  next_ply_line(file_, offset, header_.line_end);
  while (offset < file_.size()) {
    ++line_;
    const std::string_view text = next_ply_line(file_, offset, header_.line_end);
    const Words words = split_words(text);
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "format") {
      read_format(words);
    } else if (words[0] == "element") {
      read_element(words);
    } else if (words[0] == "property") {
      read_property(words);
    } else if (words[0] == "end_header") {
      return true;
    } else {
      // Most often the first line of the data: nothing after it can be trusted.
      wrong(fmt::format("expected format, comment, obj_info, element, property or end_header, found {}",
                        in_quotes(text)));
      return false;
    }
  }
  problems_.add(fmt::format("line {}: the file ends before \"end_header\"", line_));
  return false;
}

void HeaderReader::read_format(const Words& words) {
  if (has_format_) return wrong("a second \"format\" line");
  has_format_ = true;
  if (words.size() != 3) return wrong("expected \"format ENCODING 1.0\"");
  if (words[1] == "ascii") {
    header_.encoding = PlyEncoding::kAscii;
  } else if (words[1] == "binary_little_endian") {
    header_.encoding = PlyEncoding::kBinaryLittleEndian;
  } else if (words[1] == "binary_big_endian") {
    header_.encoding = PlyEncoding::kBinaryBigEndian;
  } else {
    wrong(fmt::format("unknown encoding {}, valid are ascii, binary_little_endian and binary_big_endian",
                      in_quotes(words[1])));
  }
  if (words[2] != "1.0") wrong(fmt::format("unknown version {} of the format, known is 1.0", in_quotes(words[2])));
}

void HeaderReader::read_element(const Words& words) {
  PlyElement element;
  element.line = line_;
  if (words.size() != 3) {
    wrong("expected \"element NAME COUNT\"");
  } else {
    const std::string_view count = words[2];
    const auto parsed = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (parsed.ec != std::errc() || parsed.ptr != count.data() + count.size()) {
      wrong(fmt::format("the count of an element must be a whole number from 0, found {}", in_quotes(count)));
    }
    if (!elements_.insert(words[1]).second) wrong(fmt::format("a second element named {}", in_quotes(words[1])));
    element.name = words[1];
  }
  header_.elements.push_back(std::move(element));
  properties_.clear();
}

void HeaderReader::read_property(const Words& words) {
  const bool is_list = words.size() > 1 && words[1] == "list";
  if (words.size() != (is_list ? 5 : 3)) {
    return wrong("expected \"property TYPE NAME\" or \"property list COUNT_TYPE TYPE NAME\"");
  }
  if (header_.elements.empty()) return wrong("a property before any element");
  PlyElement& element = header_.elements.back();
  PlyProperty property;
  property.name = words.back();
  if (!properties_.insert(words.back()).second) {
    wrong(fmt::format("a second property named {} of the same element", in_quotes(property.name)));
  }
  const auto type_of = [this](std::string_view word) {
    const std::optional<PlyType> type = type_named(word);
    if (!type) {
      wrong(
          fmt::format("unknown type {}, valid are char, uchar, short, ushort, int, uint, float, double and int8, "
                      "uint8, int16, uint16, int32, uint32, float32, float64",
                      in_quotes(word)));
    }
    return type.value_or(PlyType::kInt32);
  };
  if (is_list) {
    property.count_type = type_of(words[2]);
    if (is_floating(*property.count_type)) wrong("the length of a list must have an integer type");
  }
  property.type = type_of(words[words.size() - 2]);
  element.properties.push_back(std::move(property));
}

}  // namespace

const PlyProperty* PlyElement::find(std::string_view property) const {
  for (const PlyProperty& candidate : properties) {
    if (candidate.name == property) return &candidate;
  }
  return nullptr;
}

const PlyElement* PlyHeader::find(std::string_view element) const {
  for (const PlyElement& candidate : elements) {
    if (candidate.name == element) return &candidate;
  }
  return nullptr;
}

std::string_view next_ply_line(std::string_view text, size_t& offset, char line_end) {
  const size_t end = std::min(text.find(line_end, offset), text.size());
  std::string_view line = text.substr(offset, end - offset);
  offset = std::min(end + 1, text.size());
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

std::optional<PlyHeader> read_ply_header(std::string_view file, ProblemList& problems) {
  return HeaderReader(file, problems).read();
}

}  // namespace etd
