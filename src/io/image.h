// An image in memory as textures and tests read it: linear values, whatever the file stored. Nothing in it changes
// after it was made, so any thread may read it.
#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

class Image {
 public:
  // Texels row by row from the top, channels interleaved; their number must be width * height * channels, with 1
  // (grey), 3 (RGB) or 4 (RGB and alpha) channels. Alpha is never encoded.
  Image(int width, int height, int channels, std::vector<float> linear);
  Image(int width, int height, int channels, std::vector<uint8_t> encoded, ImageEncoding encoding);

  int width() const { return width_; }
  int height() const { return height_; }
  int channels() const { return channels_; }
  // The memory that the texels take.
  size_t bytes() const { return floats_.size() * sizeof(float) + bytes_.size(); }
  bool is_8bit() const { return !bytes_.empty(); }

  // The linear value of channel c of a texel; row 0 is the top row of the image. No bounds are checked in release.
  float texel(int x, int y, int c) const {
    assert(x >= 0 && x < width_ && y >= 0 && y < height_ && c >= 0 && c < channels_);
    const size_t i = (static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x)) *
                         static_cast<size_t>(channels_) +
                     static_cast<size_t>(c);
    if (bytes_.empty()) return floats_[i];
    return c == kAlpha ? static_cast<float>(bytes_[i]) / 255.0f : decoded_[bytes_[i]];
  }

 private:
  static constexpr int kAlpha = 3;
  int width_, height_, channels_;
  std::vector<float> floats_;         // or
  std::vector<uint8_t> bytes_;        // and
  std::array<float, 256> decoded_{};  // the linear value of each byte
};

// An image or why there is none (one line, without the file's name).
struct ImageResult {
  std::optional<Image> image;
  std::string error;
};

// Reads PNG, JPEG, TGA, TIFF, EXR, HDR, PFM and what else OpenImageIO knows. 8-bit files stay 8-bit; other integers are
// decoded with `encoding` too, floating-point values are taken as they are. Palettes are expanded, grey with alpha
// becomes RGB with alpha, and of layered files the channels R, G, B (and A) are taken, of files with parts the first.
// Colours are multiplied by alpha or not as the file has them. Rotation tags of cameras are not obeyed: row 0 is the
// top row that the file stores.
ImageResult read_image(const std::filesystem::path& path, ImageEncoding encoding = {});

}  // namespace etd
