#include "io/image.h"

#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <new>
#include <type_traits>

#include <fmt/format.h>

#include "io/file.h"
#include "io/oiio_setup.h"
#include "io/pfm.h"
#include "spectrum/srgb.h"

namespace etd {
namespace {

// Which channels of the file become those of the image: one grey, three colours, four with alpha.
struct ChannelChoice {
  std::vector<int> of_file;
  std::string error;
};

int find_channel(const OIIO::ImageSpec& spec, std::string_view name) {
  for (int c = 0; c < spec.nchannels; ++c) {
    if (OIIO::Strutil::iequals(spec.channelnames[static_cast<size_t>(c)],
                               OIIO::string_view(name.data(), name.size()))) {
      return c;
    }
  }
  return -1;
}

ChannelChoice choose_channels(const OIIO::ImageSpec& spec) {
  const int r = find_channel(spec, "R"), g = find_channel(spec, "G"), b = find_channel(spec, "B");
  const int a = find_channel(spec, "A");
  if (r >= 0 && g >= 0 && b >= 0) {
    if (a >= 0) return {{r, g, b, a}, {}};
    return {{r, g, b}, {}};
  }
  if (spec.nchannels == 1) return {{0}, {}};
  if (const int y = find_channel(spec, "Y"); y >= 0) {
    if (a >= 0) return {{y, y, y, a}, {}};
    return {{y}, {}};
  }
  std::string names;
  for (const std::string& name : spec.channelnames) names += (names.empty() ? "" : ", ") + name;
  return {{}, fmt::format("it has the channels {}: expected R, G, B or one channel", names)};
}

// Picks the chosen channels out of pixels of `file_channels` interleaved values.
template <class T>
void gather(const std::vector<T>& rows, int file_channels, const std::vector<int>& of_file, std::vector<T>& out) {
  const bool all =
      of_file.size() == static_cast<size_t>(file_channels) && std::is_sorted(of_file.begin(), of_file.end());
  if (all) {
    out.insert(out.end(), rows.begin(), rows.end());
    return;
  }
  for (size_t pixel = 0; pixel < rows.size(); pixel += static_cast<size_t>(file_channels)) {
    for (const int c : of_file) out.push_back(rows[pixel + static_cast<size_t>(c)]);
  }
}

// Reads the whole image a band of rows at a time, so that a header that promises more than the file holds fails before
// the memory for it is touched. Returns what went wrong, or an empty string.
template <class T>
std::string read_texels(OIIO::ImageInput& in, const OIIO::ImageSpec& spec, const std::vector<int>& of_file,
                        std::vector<T>& texels) {
  // What OpenImageIO calls half is here its bits.
  const OIIO::TypeDesc type =
      std::is_same_v<T, uint16_t> ? OIIO::TypeDesc::HALF : OIIO::TypeDesc(OIIO::BaseTypeFromC<T>::value);
  const int band = spec.tile_height > 0 ? spec.tile_height : 256;
  texels.reserve(static_cast<size_t>(spec.width) * static_cast<size_t>(spec.height) * of_file.size());
  std::vector<T> rows;
  for (int y = 0; y < spec.height; y += band) {
    const int count = std::min(band, spec.height - y);
    rows.resize(static_cast<size_t>(count) * static_cast<size_t>(spec.width) * static_cast<size_t>(spec.nchannels));
    const int begin = spec.y + y, end = begin + count;
    const bool good = spec.tile_width > 0
                          ? in.read_tiles(0, 0, spec.x, spec.x + spec.width, begin, end, spec.z, spec.z + 1, 0,
                                          spec.nchannels, type, rows.data())
                          : in.read_scanlines(0, 0, begin, end, spec.z, 0, spec.nchannels, type, rows.data());
    if (!good) return in.geterror();
    gather(rows, spec.nchannels, of_file, texels);
  }
  return {};
}

void flip_rows(std::vector<float>& texels, int height) {
  const auto row = static_cast<std::ptrdiff_t>(texels.size()) / height;
  for (std::ptrdiff_t y = 0; y < height / 2; ++y) {
    std::swap_ranges(texels.begin() + y * row, texels.begin() + (y + 1) * row, texels.end() - (y + 1) * row);
  }
}

std::string one_line(std::string text, std::string_view otherwise) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.empty() ? std::string(otherwise) : text;
}

ImageResult fail(std::string error) { return {std::nullopt, std::move(error)}; }

ImageResult read_open_image(OIIO::ImageInput& in, ImageEncoding encoding) {
  const OIIO::ImageSpec spec = in.spec();
  constexpr int kLargestSide = 1 << 17;
  if (spec.width < 1 || spec.height < 1 || spec.width > kLargestSide || spec.height > kLargestSide || spec.depth > 1) {
    return fail(
        fmt::format("it has {} x {} x {} pixels, which no image here can have", spec.width, spec.height, spec.depth));
  }
  const ChannelChoice choice = choose_channels(spec);
  if (!choice.error.empty()) return fail(choice.error);
  const int channels = static_cast<int>(choice.of_file.size());
  const auto cannot_read = [](std::string error) {
    return fail(one_line(std::move(error), "its pixels could not be read"));
  };

  if (spec.format == OIIO::TypeDesc::UINT8 && spec.channelformats.empty()) {
    std::vector<uint8_t> texels;
    if (std::string error = read_texels(in, spec, choice.of_file, texels); in.has_error() || !error.empty()) {
      return cannot_read(error + in.geterror());
    }
    return {Image(spec.width, spec.height, channels, texels, encoding), {}};
  }
  if (spec.format == OIIO::TypeDesc::HALF && spec.channelformats.empty()) {
    std::vector<uint16_t> texels;
    if (std::string error = read_texels(in, spec, choice.of_file, texels); in.has_error() || !error.empty()) {
      return cannot_read(error + in.geterror());
    }
    return {Image(spec.width, spec.height, channels, texels), {}};
  }
  std::vector<float> texels;
  if (std::string error = read_texels(in, spec, choice.of_file, texels); in.has_error() || !error.empty()) {
    return cannot_read(error + in.geterror());
  }
  if (!spec.format.is_floating_point()) {
    for (size_t i = 0; i < texels.size(); ++i) {
      const bool is_alpha = channels == 4 && i % 4 == 3;
      if (!is_alpha) texels[i] = encoding.to_linear(texels[i]);
    }
  }
  // Radiance files may run from bottom to top, which OpenImageIO only tells.
  if (std::string_view(in.format_name()) == "hdr") {
    const int orientation = spec.get_int_attribute("Orientation", 1);
    if (orientation == 4) flip_rows(texels, spec.height);
    if (orientation != 1 && orientation != 4) return fail("it is a Radiance file with turned or mirrored axes");
  }
  return {Image(spec.width, spec.height, channels, texels), {}};
}

}  // namespace

float ImageEncoding::to_linear(float encoded) const {
  switch (kind) {
    case Kind::kSrgb:
      return srgb_to_linear(encoded);
    case Kind::kLinear:
      return encoded;
    case Kind::kGamma:
      return std::pow(encoded, gamma);
  }
  return encoded;
}

std::optional<ImageEncoding> parse_image_encoding(std::string_view text) {
  if (text == "sRGB") return ImageEncoding{ImageEncoding::Kind::kSrgb, 1};
  if (text == "linear") return ImageEncoding{ImageEncoding::Kind::kLinear, 1};
  constexpr std::string_view kGamma = "gamma ";
  if (text.substr(0, kGamma.size()) != kGamma) return std::nullopt;
  std::string_view number = text.substr(kGamma.size());
  while (!number.empty() && number.front() == ' ') number.remove_prefix(1);
  float gamma = 0;
  const auto parsed = std::from_chars(number.data(), number.data() + number.size(), gamma);
  if (parsed.ec != std::errc() || parsed.ptr != number.data() + number.size()) return std::nullopt;
  if (!(gamma > 0) || !std::isfinite(gamma)) return std::nullopt;
  return ImageEncoding{ImageEncoding::Kind::kGamma, gamma};
}

TexelFormat::TexelFormat(Kind kind, ImageEncoding encoding) : kind_(kind) {
  for (size_t i = 0; i < decoded_.size(); ++i) decoded_[i] = encoding.to_linear(static_cast<float>(i) / 255.0f);
}

Image::Image(int width, int height, int channels, TexelFormat format, const std::byte* rows)
    : width_(width),
      height_(height),
      channels_(channels),
      blocks_across_(static_cast<size_t>((width + kBlock - 1) / kBlock)),
      format_(format),
      texels_(blocks_across_ * static_cast<size_t>((height + kBlock - 1) / kBlock) * (kBlock * kBlock) *
              static_cast<size_t>(channels) * format.bytes()) {
  const size_t texel = static_cast<size_t>(channels) * format.bytes();
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; x += kBlock) {
      const auto count = static_cast<size_t>(std::min(kBlock, width - x));
      std::memcpy(&texels_[index(x, y) * texel], rows, count * texel);
      rows += count * texel;
    }
}

Image::Image(int width, int height, int channels, const std::vector<float>& linear)
    : Image(width, height, channels, TexelFormat(), reinterpret_cast<const std::byte*>(linear.data())) {
  assert(linear.size() == static_cast<size_t>(width) * static_cast<size_t>(height) * static_cast<size_t>(channels));
}

Image::Image(int width, int height, int channels, const std::vector<uint8_t>& encoded, ImageEncoding encoding)
    : Image(width, height, channels, TexelFormat(TexelFormat::Kind::kByte, encoding),
            reinterpret_cast<const std::byte*>(encoded.data())) {
  assert(encoded.size() == static_cast<size_t>(width) * static_cast<size_t>(height) * static_cast<size_t>(channels));
}

Image::Image(int width, int height, int channels, const std::vector<uint16_t>& halves)
    : Image(width, height, channels, TexelFormat(TexelFormat::Kind::kHalf),
            reinterpret_cast<const std::byte*>(halves.data())) {
  assert(halves.size() == static_cast<size_t>(width) * static_cast<size_t>(height) * static_cast<size_t>(channels));
}

void Image::copy_row(int x, int y, int width, std::byte* to) const {
  const size_t texel = static_cast<size_t>(channels_) * format_.bytes();
  for (const int end = x + width; x < end;) {
    const int count = std::min(kBlock - x % kBlock, end - x);
    std::memcpy(to, &texels_[index(x, y) * texel], static_cast<size_t>(count) * texel);
    to += static_cast<size_t>(count) * texel;
    x += count;
  }
}

Image without_opaque_alpha(Image image) {
  if (image.channels_ != 4) return image;
  for (int y = 0; y < image.height_; ++y)
    for (int x = 0; x < image.width_; ++x)
      if (image.texel(x, y, 3) != 1.0f) return image;
  const size_t number = image.format_.bytes();
  std::vector<std::byte> opaque(image.texels_.size() / 4 * 3);
  for (size_t i = 0; i < image.texels_.size() / (4 * number); ++i)
    std::memcpy(&opaque[i * 3 * number], &image.texels_[i * 4 * number], 3 * number);
  image.texels_ = std::move(opaque);
  image.channels_ = 3;
  return image;
}

namespace {

// The file opened as read_image() and image_bytes() want it; null and a reason if it is no image.
std::unique_ptr<OIIO::ImageInput> open_image(const std::filesystem::path& path, std::string& error) {
  prepare_oiio();
  // Otherwise colours would be multiplied by alpha in the encoded bytes, which loses what textures need.
  OIIO::ImageSpec config;
  config["oiio:UnassociatedAlpha"] = 1;
  std::unique_ptr<OIIO::ImageInput> in = OIIO::ImageInput::open(path.string(), &config);
  if (in == nullptr) error = one_line(OIIO::geterror(), "not an image of a known format");
  return in;
}

bool is_pfm(const std::filesystem::path& path) { return OIIO::Strutil::iequals(path.extension().string(), ".pfm"); }

}  // namespace

ImageResult read_image(const std::filesystem::path& path, ImageEncoding encoding) {
  std::error_code failed;
  const std::filesystem::file_status status = std::filesystem::status(path, failed);
  if (!std::filesystem::exists(status)) return fail("the file does not exist");
  if (!std::filesystem::is_regular_file(status)) return fail("not a regular file");
  if (is_pfm(path)) {
    const FileBytes file = read_file(path);
    return file.error.empty() ? decode_pfm(file.bytes) : fail(file.error);
  }
  try {
    std::string error;
    const std::unique_ptr<OIIO::ImageInput> in = open_image(path, error);
    return in ? read_open_image(*in, encoding) : fail(error);
  } catch (const std::bad_alloc&) {
    return fail("there is not enough memory for it");
  } catch (const std::exception& error) {
    return fail(one_line(error.what(), "it could not be read"));
  }
}

size_t image_bytes(const std::filesystem::path& path) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(path, failed)) return 0;
  if (is_pfm(path)) {
    const auto size = std::filesystem::file_size(path, failed);
    return failed ? 0 : static_cast<size_t>(size);
  }
  try {
    std::string error;
    const std::unique_ptr<OIIO::ImageInput> in = open_image(path, error);
    if (in == nullptr) return 0;
    const OIIO::ImageSpec spec = in->spec();
    const ChannelChoice choice = choose_channels(spec);
    const bool same = spec.channelformats.empty();
    const size_t number = same && spec.format == OIIO::TypeDesc::UINT8  ? 1
                          : same && spec.format == OIIO::TypeDesc::HALF ? 2
                                                                        : 4;
    return static_cast<size_t>(std::max(spec.width, 0)) * static_cast<size_t>(std::max(spec.height, 0)) *
           choice.of_file.size() * number;
  } catch (const std::exception&) {
    return 0;
  }
}

}  // namespace etd
