#include "io/radiance.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "io/file.h"
#include "io/image_limits.h"
#include "spectrum/color_space.h"

namespace etd {
namespace {

using Rgbe = std::array<uint8_t, 4>;

struct Header {
  bool xyz = false;
  double exposure = 1;
  int rows = 0, columns = 0;                     // as they are stored
  bool rows_are_columns = false;                 // a stored row is a column of the picture
  bool from_right = false, from_bottom = false;  // where stored rows and columns begin
  std::string error;

  int width() const { return rows_are_columns ? rows : columns; }
  int height() const { return rows_are_columns ? columns : rows; }
};

std::string_view take_line(std::string_view& left) {
  const std::string_view line = left.substr(0, left.find('\n'));
  left.remove_prefix(std::min(line.size() + 1, left.size()));
  return !line.empty() && line.back() == '\r' ? line.substr(0, line.size() - 1) : line;
}

std::string_view take_word(std::string_view& left) {
  left.remove_prefix(std::min(left.find_first_not_of(' '), left.size()));
  const std::string_view word = left.substr(0, left.find(' '));
  left.remove_prefix(word.size());
  return word;
}

template <class T>
bool parse(std::string_view word, T& value) {
  const auto parsed = std::from_chars(word.data(), word.data() + word.size(), value);
  return parsed.ec == std::errc() && parsed.ptr == word.data() + word.size();
}

// "-Y 480 +X 640" and the seven other ways: the first axis runs from row to row, the second along them.
bool parse_size(std::string_view line, Header& header) {
  std::string_view left = line;
  const std::string_view slow = take_word(left), rows = take_word(left), fast = take_word(left),
                         columns = take_word(left);
  const auto is_axis = [](std::string_view w) {
    return w.size() == 2 && (w[0] == '+' || w[0] == '-') && (w[1] == 'X' || w[1] == 'Y');
  };
  if (!is_axis(slow) || !is_axis(fast) || slow[1] == fast[1] || !take_word(left).empty()) return false;
  header.rows_are_columns = slow[1] == 'X';
  const char x = header.rows_are_columns ? slow[0] : fast[0], y = header.rows_are_columns ? fast[0] : slow[0];
  header.from_right = x == '-';
  header.from_bottom = y == '+';
  constexpr int kLargestSide = 1 << 17;
  return parse(rows, header.rows) && parse(columns, header.columns) && header.rows > 0 && header.columns > 0 &&
         header.rows <= kLargestSide && header.columns <= kLargestSide;
}

// Lines up to an empty one, and the size.
Header take_header(std::string_view& left) {
  Header header;
  take_line(left);
  while (!left.empty()) {
    std::string_view line = take_line(left);
    if (line.empty()) break;
    constexpr std::string_view kFormat = "FORMAT=", kExposure = "EXPOSURE=";
    if (line.substr(0, kFormat.size()) == kFormat) {
      std::string_view format = line.substr(kFormat.size());
      format = take_word(format);
      header.xyz = format == "32-bit_rle_xyze";
      if (!header.xyz && format != "32-bit_rle_rgbe")
        header.error = fmt::format(
            "it is a Radiance picture of format {}, known are 32-bit_rle_rgbe and "
            "32-bit_rle_xyze",
            in_quotes(format));
    } else if (line.substr(0, kExposure.size()) == kExposure) {
      std::string_view words = line.substr(kExposure.size());
      double factor = 0;
      if (parse(take_word(words), factor) && factor > 0) header.exposure *= factor;
    }
  }
  const std::string_view size = take_line(left);
  if (header.error.empty() && !parse_size(size, header))
    header.error =
        fmt::format("expected the size of a Radiance picture, such as \"-Y 480 +X 640\", found {}", in_quotes(size));
  return header;
}

bool take(std::string_view& left, Rgbe& pixel) {
  if (left.size() < 4) return false;
  for (size_t i = 0; i < 4; ++i) pixel[i] = static_cast<uint8_t>(left[i]);
  left.remove_prefix(4);
  return true;
}

// Pixels as they are; (1, 1, 1, n) repeats the last one n times, and the next such n counts 256 times as much.
bool take_old_row(std::string_view& left, std::vector<Rgbe>& row) {
  int shift = 0;
  for (size_t i = 0; i < row.size();) {
    Rgbe pixel;
    if (!take(left, pixel)) return false;
    if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
      row[i++] = pixel;
      shift = 0;
      continue;
    }
    const size_t count = shift < 32 ? size_t{pixel[3]} << shift : 0;
    if (i == 0 || count > row.size() - i) return false;
    std::fill_n(row.begin() + static_cast<std::ptrdiff_t>(i), count, row[i - 1]);
    i += count;
    shift += 8;
  }
  return true;
}

// All of the first component, then the others: n > 128 repeats a byte n - 128 times, other n are followed by n bytes.
bool take_new_row(std::string_view& left, std::vector<Rgbe>& row) {
  for (size_t c = 0; c < 4; ++c)
    for (size_t i = 0; i < row.size();) {
      if (left.size() < 2) return false;
      const auto code = static_cast<uint8_t>(left[0]);
      const size_t count = code > 128 ? code - 128u : code;
      if (count == 0 || count > row.size() - i || (code <= 128 && left.size() <= count)) return false;
      for (size_t k = 0; k < count; ++k) row[i++][c] = static_cast<uint8_t>(left[code > 128 ? 1 : 1 + k]);
      left.remove_prefix(code > 128 ? 2 : 1 + count);
    }
  return true;
}

bool take_row(std::string_view& left, std::vector<Rgbe>& row) {
  const size_t width = row.size();
  const auto byte = [&left](size_t i) { return i < left.size() ? static_cast<uint8_t>(left[i]) : 0u; };
  if (width < 8 || width > 0x7fff || byte(0) != 2 || byte(1) != 2 || byte(2) > 127) return take_old_row(left, row);
  if ((byte(2) << 8 | byte(3)) != width) return false;
  left.remove_prefix(4);
  return take_new_row(left, row);
}

std::array<float, 3> color_of(const Rgbe& pixel, bool xyz) {
  const double scale = pixel[3] == 0 ? 0.0 : std::ldexp(1.0, pixel[3] - 136);
  Vec3d c{pixel[0] * scale, pixel[1] * scale, pixel[2] * scale};
  if (xyz) c = xyz_to_rec709(c);
  return {static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z)};
}

}  // namespace

ImageResult decode_radiance(std::string_view bytes, const Limits& limits) {
  ImageResult result;
  std::string_view left = bytes;
  const Header header = take_header(left);
  if (!header.error.empty()) return result.error = header.error, result;
  const auto width = static_cast<size_t>(header.width()), height = static_cast<size_t>(header.height());
  result.error = image_size_problem(width, height, 3 * sizeof(float), bytes.size(), limits);
  if (!result.error.empty()) return result;
  std::vector<float> texels;
  std::vector<Rgbe> row(static_cast<size_t>(header.columns));
  // Row by row, so that a size that the file does not hold is found before there is memory for it.
  texels.reserve(std::min(3 * width * height, 64 * bytes.size()));
  for (int i = 0; i < header.rows; ++i) {
    if (!take_row(left, row))
      return result.error = fmt::format("its row {} of {} is damaged or incomplete", i + 1, header.rows), result;
    for (const Rgbe& pixel : row)
      for (const float v : color_of(pixel, header.xyz)) texels.push_back(v);
  }
  if (header.rows_are_columns || header.from_right || header.from_bottom) {
    std::vector<float> upright(texels.size());
    for (size_t y = 0; y < height; ++y)
      for (size_t x = 0; x < width; ++x) {
        const size_t from_x = header.from_right ? width - 1 - x : x, from_y = header.from_bottom ? height - 1 - y : y;
        const size_t stored = header.rows_are_columns ? from_x * height + from_y : from_y * width + from_x;
        std::copy_n(&texels[3 * stored], 3, &upright[3 * (y * width + x)]);
      }
    texels = std::move(upright);
  }
  if (std::abs(header.exposure - 1) > 1e-6)
    result.notes.push_back(
        fmt::format("its values were multiplied by an EXPOSURE of {:.6g}, which is not undone", header.exposure));
  result.image = Image(header.width(), header.height(), 3, texels);
  return result;
}

size_t radiance_bytes(std::string_view bytes) {
  std::string_view left = bytes;
  const Header header = take_header(left);
  if (!header.error.empty()) return 0;
  return 3 * sizeof(float) * static_cast<size_t>(header.width()) * static_cast<size_t>(header.height());
}

}  // namespace etd
