#include "io/image_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "io/file.h"

namespace etd {
namespace {

// The bytes of a file as numbers, one after the other; zeros behind its end.
class ByteReader {
 public:
  explicit ByteReader(const std::filesystem::path& path) : in_(path, std::ios::binary) {
    std::error_code failed;
    size_ = std::filesystem::file_size(path, failed);
    if (failed) size_ = 0;
  }
  uint64_t size() const { return size_; }
  uint64_t left() const { return at_ < size_ ? size_ - at_ : 0; }
  void skip(uint64_t bytes) {
    at_ += bytes;
    in_.seekg(static_cast<std::streamoff>(std::min(at_, size_)));
  }
  uint32_t byte() {
    const int c = left() > 0 ? in_.get() : 0;
    ++at_;
    return c < 0 ? 0u : static_cast<uint32_t>(c);
  }
  uint32_t big16() {
    const uint32_t high = byte();
    return high << 8 | byte();
  }
  uint32_t little16() {
    const uint32_t low = byte();
    return byte() << 8 | low;
  }
  uint32_t little32() {
    const uint32_t low = little16();
    return little16() << 16 | low;
  }
  // Reads up to the next zero.
  std::string text() {
    constexpr size_t kLongest = 256;
    std::string text;
    for (uint32_t c = byte(); c != 0 && text.size() < kLongest; c = byte()) text += static_cast<char>(c);
    return text;
  }

 private:
  std::ifstream in_;
  uint64_t size_ = 0, at_ = 0;
};

// The library takes the length of a text or a preview picture for true. Format: "OpenEXR File Layout", magic number and
// version, then headers of attributes (name, type, size, value), each ended by an empty name.
std::string exr_problem(ByteReader& in) {
  constexpr uint32_t kMultiPart = 0x1000;
  const bool many = (in.little32() & kMultiPart) != 0;
  bool ended = false;
  while (in.left() > 0) {
    const std::string name = in.text();
    if (name.empty()) {
      // The end of a header; an empty header ends those of several parts.
      if (!many || ended) return {};
      ended = true;
      continue;
    }
    ended = false;
    in.text();
    const uint32_t bytes = in.little32();
    if (bytes > in.left())
      return fmt::format("the attribute {} of its header should have {} bytes, but only {} follow", in_quotes(name),
                         bytes, in.left());
    in.skip(bytes);
  }
  return {};
}

// The size stands in the frame header (SOF); the coefficients of a progressive image are all kept, in 16 bits each.
std::string jpeg_problem(ByteReader& in, const Limits& limits) {
  while (in.left() > 0) {
    if (in.byte() != 0xff) return {};
    uint32_t marker = in.byte();
    while (marker == 0xff) marker = in.byte();
    const uint32_t length = in.big16();
    const bool is_frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (is_frame) {
      in.byte();
      const uint32_t height = in.big16(), width = in.big16(), components = in.byte();
      return image_size_problem(width, height, 2 * components, in.size(), limits);
    }
    if (length < 2 || marker == 0xda) return {};
    in.skip(length - 2);
  }
  return {};
}

}  // namespace

std::string image_header_problem(const std::filesystem::path& path, const Limits& limits) {
  ByteReader in(path);
  std::array<uint32_t, 4> magic{};
  for (uint32_t& c : magic) c = in.byte();
  if (magic == std::array<uint32_t, 4>{0x76, 0x2f, 0x31, 0x01}) return exr_problem(in);
  if (magic[0] == 0xff && magic[1] == 0xd8) {
    ByteReader after_magic(path);
    after_magic.skip(2);
    return jpeg_problem(after_magic, limits);
  }
  if (magic == std::array<uint32_t, 4>{'G', 'I', 'F', '8'}) {
    in.skip(2);
    const uint32_t width = in.little16(), height = in.little16();
    return image_size_problem(width, height, 4, in.size(), limits);
  }
  return {};
}

std::string image_size_problem(uint64_t width, uint64_t height, uint64_t bytes_per_pixel, uint64_t file_bytes,
                               const Limits& limits) {
  const double bytes = static_cast<double>(width) * static_cast<double>(height) * static_cast<double>(bytes_per_pixel);
  if (bytes <= static_cast<double>(limits.unpacked_from(file_bytes))) return {};
  return fmt::format("its {} x {} pixels take {:.0f} MiB in memory, more than {} times its size; {}", width, height,
                     bytes / (1 << 20),
                     static_cast<uint64_t>(bytes / static_cast<double>(std::max<uint64_t>(file_bytes, 1))),
                     limit_text(limits, &Limits::unpacked));
}

}  // namespace etd
