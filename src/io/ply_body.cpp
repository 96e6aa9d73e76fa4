#include "io/ply_body.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "io/decimal.h"
#include "io/file.h"
#include "io/ply_rows.h"

namespace etd {
namespace {

// One property list for both encodings. `Body` reads a scalar with value(type, double&), passes over scalars with
// skip(type, count), and gives up on the rest of the element with a step other than kDone.
template <class Body>
PlyStep read_properties(Body& body, const PlyPlan& plan, PlyValues& values) {
  for (size_t i = 0; i < plan.slots.size(); ++i) {
    const PlyProperty& property = plan.element->properties[i];
    const bool wanted = plan.slots[i] != PlyPlan::kSkip;
    uint64_t length = 1;
    if (property.count_type) {
      double count = 0;
      if (const PlyStep step = body.value(*property.count_type, property, count); step != PlyStep::kDone) return step;
      if (const PlyStep step = body.check_length(property, count); step != PlyStep::kDone) return step;
      length = static_cast<uint64_t>(count);
      if (wanted) values.list.resize(length);
    }
    if (!wanted) {
      if (const PlyStep step = body.skip(property, length); step != PlyStep::kDone) return step;
      continue;
    }
    double* out = property.count_type ? values.list.data() : &values.scalars[static_cast<size_t>(plan.slots[i])];
    for (uint64_t k = 0; k < length; ++k) {
      if (const PlyStep step = body.value(property.type, property, out[k]); step != PlyStep::kDone) return step;
    }
  }
  return PlyStep::kDone;
}

class BinaryBody final : public PlyBody {
 public:
  BinaryBody(std::string_view data, bool swap_bytes) : left_(data), swap_(swap_bytes) {}

  PlyStep read(const PlyPlan& plan, PlyValues& values) override { return read_properties(*this, plan, values); }

  void read_rows(const PlyPlan& plan, uint64_t most, std::vector<PlyScalars>& rows) override {
    const size_t bytes = ply_row_bytes(*plan.element);
    rows.resize(bytes == 0 ? 0 : std::min<uint64_t>({most, left_.size() / bytes, kPlyRows}));
    convert_ply_rows(left_.data(), plan, swap_, rows);
    left_.remove_prefix(bytes * rows.size());
  }

  uint64_t read_triangles(const PlyPlan& plan, uint64_t most, uint64_t vertices, FaceList& faces) override {
    return take_ply_triangles(left_, plan, swap_, most, vertices, faces);
  }

  int line() const override { return 0; }

  double least_bytes(const PlyElement& element) const override {
    uint64_t bytes = 0;
    for (const PlyProperty& property : element.properties) {
      bytes += ply_type_bytes(property.count_type.value_or(property.type));
    }
    return static_cast<double>(bytes) * static_cast<double>(element.count);
  }

  size_t bytes_left() const override { return left_.size(); }

  // Padding with spaces, line ends or zeros is harmless.
  std::string leftover() const override {
    if (left_.find_first_not_of(std::string_view(" \t\r\n\0", 5)) == std::string_view::npos) return {};
    return fmt::format("{} bytes follow the last element: does the header count too few?", left_.size());
  }

  PlyStep value(PlyType type, const PlyProperty& property, double& out) {
    const size_t bytes = ply_type_bytes(type);
    if (left_.size() < bytes) return truncated(property);
    switch (type) {
      case PlyType::kInt8:
        out = take<int8_t>();
        break;
      case PlyType::kUint8:
        out = take<uint8_t>();
        break;
      case PlyType::kInt16:
        out = take<int16_t>();
        break;
      case PlyType::kUint16:
        out = take<uint16_t>();
        break;
      case PlyType::kInt32:
        out = take<int32_t>();
        break;
      case PlyType::kUint32:
        out = take<uint32_t>();
        break;
      case PlyType::kFloat32:
        out = static_cast<double>(take<float>());
        break;
      case PlyType::kFloat64:
        out = take<double>();
        break;
    }
    return PlyStep::kDone;
  }

  // A wrong length is fatal: where the next element begins depends on it.
  PlyStep check_length(const PlyProperty& list, double count) {
    if (count < 0) {
      error_ = fmt::format("list {} has a negative length {}", list.name, count);
      return PlyStep::kLost;
    }
    if (count * static_cast<double>(ply_type_bytes(list.type)) > static_cast<double>(left_.size())) {
      error_ = fmt::format("list {} of {} values runs past the end of the file", list.name, count);
      return PlyStep::kLost;
    }
    return PlyStep::kDone;
  }

  PlyStep skip(const PlyProperty& property, uint64_t count) {
    const uint64_t bytes = ply_type_bytes(property.type) * count;
    if (left_.size() < bytes) return truncated(property);
    left_.remove_prefix(bytes);
    return PlyStep::kDone;
  }

 private:
  PlyStep truncated(const PlyProperty& property) {
    error_ = fmt::format("the file ends before its {}", property.name);
    return PlyStep::kLost;
  }

  template <class T>
  T take() {
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), left_.data(), sizeof(T));
    if (swap_) std::reverse(raw.begin(), raw.end());
    left_.remove_prefix(sizeof(T));
    T value;
    std::memcpy(&value, raw.data(), sizeof(T));
    return value;
  }

  std::string_view left_;
  bool swap_;
};

// One line is one element, as the format wants it: a value too few or too many is found where it is, and the next line
// can be read all the same.
class AsciiBody final : public PlyBody {
 public:
  AsciiBody(const PlyHeader& header, std::string_view file)
      : file_(file), offset_(header.data_offset), next_line_(header.data_line), line_end_(header.line_end) {}

  PlyStep read(const PlyPlan& plan, PlyValues& values) override {
    do {
      if (offset_ >= file_.size()) {
        error_ = "the file ends before it";
        return PlyStep::kLost;
      }
      left_ = next_ply_line(file_, offset_, line_end_);
      line_ = next_line_++;
      trim();
    } while (left_.empty());
    const PlyStep step = read_properties(*this, plan, values);
    if (step != PlyStep::kDone || left_.empty()) return step;
    error_ = fmt::format("{} too much on the line", in_quotes(left_));
    return PlyStep::kBad;
  }

  int line() const override { return line_; }

  // Each value takes a character and a separator.
  double least_bytes(const PlyElement& element) const override {
    return 2.0 * static_cast<double>(element.properties.size()) * static_cast<double>(element.count) - 1.0;
  }

  size_t bytes_left() const override { return file_.size() - offset_; }

  std::string leftover() const override {
    const size_t extra = file_.find_first_not_of(std::string_view(" \t\r\n\0", 5), offset_);
    if (extra == std::string_view::npos) return {};
    const auto lines = std::count(file_.begin() + static_cast<std::ptrdiff_t>(offset_),
                                  file_.begin() + static_cast<std::ptrdiff_t>(extra), line_end_);
    return fmt::format("line {}: data follow the last element: does the header count too few?", next_line_ + lines);
  }

  PlyStep value(PlyType type, const PlyProperty& property, double& out) {
    const char* const end = left_.data() + left_.size();
    if (const char* const after = read_decimal(left_.data(), end, out); after && (after == end || is_blank(*after))) {
      left_.remove_prefix(static_cast<size_t>(after - left_.data()));
      trim();
      if (type == PlyType::kFloat32) out = static_cast<double>(static_cast<float>(out));
      return PlyStep::kDone;
    }
    const std::string_view word = take_word();
    if (word.empty()) {
      error_ = fmt::format("the line ends before its {}", property.name);
      return PlyStep::kBad;
    }
    const std::string_view number = word.front() == '+' ? word.substr(1) : word;
    const auto parsed = std::from_chars(number.data(), number.data() + number.size(), out);
    if (parsed.ptr != number.data() + number.size() || parsed.ec == std::errc::invalid_argument) {
      error_ = fmt::format("{} is not a number ({})", in_quotes(word), property.name);
      return PlyStep::kBad;
    }
    // Too large or too small for a double: strtod tells which, with its infinity or the nearest tiny number.
    if (parsed.ec == std::errc::result_out_of_range) out = std::strtod(std::string(number).c_str(), nullptr);
    if (type == PlyType::kFloat32) out = static_cast<double>(static_cast<float>(out));
    return PlyStep::kDone;
  }

  PlyStep check_length(const PlyProperty& list, double count) {
    if (!(count >= 0) || count != std::floor(count)) {
      error_ = fmt::format("list {} cannot have {} values", list.name, count);
      return PlyStep::kBad;
    }
    if (2.0 * count - 1.0 > static_cast<double>(left_.size())) {
      error_ = fmt::format("list {} of {} values is longer than its line", list.name, count);
      return PlyStep::kBad;
    }
    return PlyStep::kDone;
  }

  PlyStep skip(const PlyProperty& property, uint64_t count) {
    for (uint64_t k = 0; k < count; ++k) {
      if (take_word().empty()) {
        error_ = fmt::format("the line ends before its {}", property.name);
        return PlyStep::kBad;
      }
    }
    return PlyStep::kDone;
  }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t'; }
  void trim() {
    while (!left_.empty() && is_blank(left_.front())) left_.remove_prefix(1);
  }
  // The next word of the line, behind which and the blanks after it the line goes on.
  std::string_view take_word() {
    size_t end = 0;
    while (end < left_.size() && !is_blank(left_[end])) ++end;
    const std::string_view word = left_.substr(0, end);
    left_.remove_prefix(end);
    trim();
    return word;
  }

  std::string_view file_;
  std::string_view left_;  // of the current line
  size_t offset_;
  int line_ = 0;
  int next_line_;
  char line_end_;
};

bool machine_is_little_endian() {
  const uint16_t one = 1;
  unsigned char first;
  std::memcpy(&first, &one, 1);
  return first == 1;
}

}  // namespace

std::unique_ptr<PlyBody> open_ply_body(const PlyHeader& header, std::string_view file) {
  if (header.encoding == PlyEncoding::kAscii) return std::make_unique<AsciiBody>(header, file);
  const bool little = header.encoding == PlyEncoding::kBinaryLittleEndian;
  return std::make_unique<BinaryBody>(file.substr(header.data_offset), little != machine_is_little_endian());
}

}  // namespace etd
