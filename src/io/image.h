// An image in memory as textures and tests read it: linear values, whatever the file stored. Nothing in it changes
// after it was made, so any thread may read it.
#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/half.h"
#include "params/limits.h"

namespace etd {

// How integers of a file stand for linear values. Floating-point files are linear and have no encoding.
struct ImageEncoding {
  enum class Kind { kSrgb, kLinear, kGamma };
  Kind kind = Kind::kSrgb;
  float gamma = 1;  // kGamma: linear = encoded^gamma

  // The linear value of an encoded one in [0, 1].
  float to_linear(float encoded) const;
};

// "sRGB", "linear" or "gamma X" with X > 0, as the pbrt-v4 language writes them; nothing for any other text.
std::optional<ImageEncoding> parse_image_encoding(std::string_view text);
std::string image_encoding_name(ImageEncoding encoding);

// How texels are stored, and what stored ones stand for.
class TexelFormat {
 public:
  enum class Kind : uint8_t { kByte, kHalf, kFloat };

  TexelFormat() = default;  // float
  explicit TexelFormat(Kind kind, ImageEncoding encoding = {ImageEncoding::Kind::kLinear, 1});

  Kind kind() const { return kind_; }
  size_t bytes() const { return kind_ == Kind::kByte ? 1 : kind_ == Kind::kHalf ? 2 : 4; }
  // The linear value of number i of an array in this format, which is channel c of its texel. Alpha is never encoded.
  float value(const std::byte* texels, size_t i, int c) const {
    if (kind_ == Kind::kByte) {
      const auto byte = static_cast<uint8_t>(texels[i]);
      return c == kAlpha ? static_cast<float>(byte) / 255.0f : decoded_[byte];
    }
    if (kind_ == Kind::kHalf) {
      uint16_t half;
      std::memcpy(&half, texels + 2 * i, sizeof half);
      return half_to_float(half);
    }
    float value;
    std::memcpy(&value, texels + 4 * i, sizeof value);
    return value;
  }
  // Grey in all channels, opaque where there is no alpha: texel i of an array with this many channels.
  std::array<float, 4> rgba(const std::byte* texels, size_t i, int channels) const {
    const size_t first = i * static_cast<size_t>(channels);
    if (channels == 1) {
      const float grey = value(texels, first, 0);
      return {grey, grey, grey, 1.0f};
    }
    return {value(texels, first, 0), value(texels, first + 1, 1), value(texels, first + 2, 2),
            channels == 4 ? value(texels, first + 3, kAlpha) : 1.0f};
  }

 private:
  static constexpr int kAlpha = 3;
  Kind kind_ = Kind::kFloat;
  std::array<float, 256> decoded_{};  // the linear value of each byte
};

struct MendedImage;

class Image {
 public:
  // Texels row by row from the top, channels interleaved; their number must be width * height * channels, with 1
  // (grey), 3 (RGB) or 4 (RGB and alpha) channels. Alpha is never encoded.
  Image(int width, int height, int channels, const std::vector<float>& linear);
  Image(int width, int height, int channels, const std::vector<uint8_t>& encoded, ImageEncoding encoding);
  // The bits of halves (core/half.h).
  Image(int width, int height, int channels, const std::vector<uint16_t>& linear_halves);

  int width() const { return width_; }
  int height() const { return height_; }
  int channels() const { return channels_; }
  // The memory that the texels take.
  size_t bytes() const { return texels_.size(); }
  const TexelFormat& format() const { return format_; }

  // The linear value of channel c of a texel; row 0 is the top row of the image. No bounds are checked in release.
  float texel(int x, int y, int c) const {
    assert(c >= 0 && c < channels_);
    return format_.value(texels_.data(), index(x, y) * static_cast<size_t>(channels_) + static_cast<size_t>(c), c);
  }
  std::array<float, 4> rgba(int x, int y) const { return format_.rgba(texels_.data(), index(x, y), channels_); }
  // Copies `width` texels of row y from column x on, as they are stored.
  void copy_row(int x, int y, int width, std::byte* to) const;

 private:
  friend Image without_opaque_alpha(Image image);
  friend MendedImage mend_texels(Image image);
  static constexpr int kBlock = 8;  // texels near each other in the image are near in memory, too

  Image(int width, int height, int channels, TexelFormat format, const std::byte* rows);
  // The format must not be bytes.
  void set_texel(int x, int y, int c, float linear);
  // Returns the place of a texel, in units of texels.
  size_t index(int x, int y) const {
    assert(x >= 0 && x < width_ && y >= 0 && y < height_);
    const size_t block = static_cast<size_t>(y / kBlock) * blocks_across_ + static_cast<size_t>(x / kBlock);
    return block * (kBlock * kBlock) + static_cast<size_t>(y % kBlock * kBlock + x % kBlock);
  }

  int width_, height_, channels_;
  size_t blocks_across_;
  TexelFormat format_;
  std::vector<std::byte> texels_;
};

// An image or why there is none (one line, without the file's name).
struct ImageResult {
  std::optional<Image> image;
  std::string error;
  std::vector<std::string> notes;  // what was not taken, or not as it stands
  ImageEncoding encoding;          // of its integers
  bool needs_layer = false;        // the error could be mended by naming a part or layer
};

struct ImageOptions {
  std::optional<ImageEncoding> encoding;  // of integers; otherwise what the file says, or sRGB
  std::string layer;                      // the part or layer of an EXR file; empty: the one that has R, G and B
  Limits limits = {};                     // an image that is much larger than its file is an error
};

// Reads PNG, JPEG, TGA, TIFF, EXR, HDR, PFM and what else OpenImageIO knows. 8-bit files stay 8-bit and half files
// half; other integers are decoded too, floating-point values are taken as they are. Palettes are expanded, grey with
// alpha becomes RGB with alpha, luminance with chroma RGB, and of EXR files the part or layer with channels R, G, B
// (and A) is taken (io/codecs/image_channels.h), placed in its display window. Colours are multiplied by alpha or not
// as the file has them. Rotation tags of cameras are not obeyed: row 0 is the top row that the file stores.
ImageResult read_image(const std::filesystem::path& path, const ImageOptions& options = {});

// The memory that an image will take, without reading it; 0 when it can't be read.
size_t image_bytes(const std::filesystem::path& path, const ImageOptions& options = {});

// The same image with the mean of its finite neighbours in place of each texel that is not finite in all channels.
struct MendedImage {
  Image image;
  size_t texels = 0;  // that were not finite; all of them: nothing could be done
  int x = 0, y = 0;   // of the first
};
MendedImage mend_texels(Image image);
bool is_finite(const Image& image);
// The image mended, with a note. One without a finite texel is an error.
ImageResult finite_image(Image image);
// read_image() as textures and lights want it: as finite_image() gives it.
ImageResult read_finite_image(const std::filesystem::path& path, const ImageOptions& options = {});

// The image without an alpha that is 1 everywhere.
Image without_opaque_alpha(Image image);

}  // namespace etd
