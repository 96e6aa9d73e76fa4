#include "io/image.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "spectrum/srgb.h"

namespace etd {

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

std::string image_encoding_name(ImageEncoding encoding) {
  if (encoding.kind == ImageEncoding::Kind::kGamma) return fmt::format("gamma {}", encoding.gamma);
  return encoding.kind == ImageEncoding::Kind::kSrgb ? "sRGB" : "linear";
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

}  // namespace etd
