#include "io/pfm.h"

#include <charconv>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "core/math.h"
#include "io/file.h"

namespace etd {
namespace {

constexpr std::string_view kBlank = " \t\r\n";

// The next word of the header, removed from `left`; empty at the end.
std::string_view take_word(std::string_view& left) {
  left.remove_prefix(std::min(left.find_first_not_of(kBlank), left.size()));
  const std::string_view word = left.substr(0, left.find_first_of(kBlank));
  left.remove_prefix(word.size());
  return word;
}

template <class T>
bool parse(std::string_view word, T& value) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  const auto parsed = std::from_chars(word.data(), word.data() + word.size(), value);
  return parsed.ec == std::errc() && parsed.ptr == word.data() + word.size();
}

float float_at(const char* raw, bool little_endian) {
  uint32_t bits = 0;
  for (int i = 0; i < 4; ++i) {
    const auto byte = static_cast<unsigned char>(raw[little_endian ? 3 - i : i]);
    bits = bits << 8 | byte;
  }
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

ImageResult fail(std::string error) { return {std::nullopt, std::move(error), {}, {}, false}; }

}  // namespace

ImageResult decode_pfm(std::string_view bytes) {
  std::string_view left = bytes;
  const std::string_view magic = take_word(left);
  if (magic != "PF" && magic != "Pf") return fail("not a PFM file, it must begin with \"PF\" or \"Pf\"");
  const int channels = magic == "PF" ? 3 : 1;
  const std::string_view words[] = {take_word(left), take_word(left), take_word(left)};
  int width = 0, height = 0;
  float scale = 0;
  if (!parse(words[0], width) || !parse(words[1], height) || width < 1 || height < 1) {
    return fail(fmt::format("expected the width and height of the image, found {} {}", in_quotes(words[0]),
                            in_quotes(words[1])));
  }
  if (!parse(words[2], scale) || scale == 0 || !std::isfinite(scale)) {
    return fail(fmt::format("expected a scale that is not 0, found {}", in_quotes(words[2])));
  }
  // One blank ends the header; CR LF counts as one.
  left.remove_prefix(left.substr(0, 2) == "\r\n" ? 2 : std::min<size_t>(1, left.size()));
  const size_t row = static_cast<size_t>(width) * static_cast<size_t>(channels);
  if (left.size() / sizeof(float) / row < static_cast<size_t>(height)) {
    return fail(fmt::format("{} x {} pixels of {} channels do not fit into the {} bytes after the header", width,
                            height, channels, left.size()));
  }
  std::vector<float> texels;
  texels.reserve(row * static_cast<size_t>(height));
  for (size_t y = static_cast<size_t>(height); y-- > 0;) {
    for (size_t i = y * row; i < (y + 1) * row; ++i) {
      texels.push_back(std::abs(scale) * float_at(left.data() + i * sizeof(float), scale < 0));
    }
  }
  return {Image(width, height, channels, texels), {}, {}, {}, false};
}

std::string pfm_header(int width, int height) { return fmt::format("PF\n{} {}\n-1.0\n", width, height); }

std::string pfm_row(std::span<const float> rgb) {
  std::string bytes;
  bytes.reserve(rgb.size_bytes());
  for (const float v : rgb) {
    const uint32_t bits = float_bits(v);
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(bits >> shift & 0xffu);
  }
  return bytes;
}

std::string encode_pfm(int width, int height, std::span<const float> rgb) {
  std::string bytes = pfm_header(width, height);
  const size_t row = 3 * static_cast<size_t>(width);
  bytes.reserve(bytes.size() + rgb.size_bytes());
  for (size_t y = static_cast<size_t>(height); y-- > 0;) bytes += pfm_row(rgb.subspan(y * row, row));
  return bytes;
}

}  // namespace etd
