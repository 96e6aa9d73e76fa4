// Writing images: layered float EXR for what a renderer knows, and plain RGB files for looking at. Every file is
// written beside its place and renamed when it is complete: nobody ever finds half an image.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace etd {

using MetadataValue = std::variant<std::string, int, float, double>;

// What is known about an image of named channels ("R", "direct.R", "depth.Z"), perhaps a crop of a larger one, before
// there are pixels.
struct ImageHeader {
  int width = 0, height = 0;            // of the pixels that exist (the data window)
  int x = 0, y = 0;                     // their top left corner in the full image
  int full_width = 0, full_height = 0;  // of the full image (the display window), which starts at 0, 0
  std::vector<std::string> channels;
  std::vector<std::pair<std::string, MetadataValue>> metadata;
  bool half = false;  // written with 16-bit floats

  // The index of a channel, -1 when there is none of this name.
  int find(std::string_view channel) const;
  // The value of a metadata entry; null when there is none of this name.
  const MetadataValue* find_metadata(std::string_view name) const;
};

// An image in memory.
struct LayeredImage : ImageHeader {
  std::vector<float> pixels;  // rows from the top, channels interleaved in the order of `channels`

  // One channel as a plane of width * height values; empty when there is none of this name.
  std::vector<float> plane(std::string_view channel) const;
};

// Appends the values of a row, counted from the top of what exists, channels interleaved.
using RowSource = std::function<void(int row, std::vector<float>& to)>;

// An image whose rows are made when they are asked for, in any order: large ones are written without a copy in memory.
struct RowImage : ImageHeader {
  RowSource append_row;
};

// The rows of an image in memory, which must outlive them; and back.
RowImage rows_of(const LayeredImage& image);
LayeredImage all_rows(const RowImage& image);

// Writes an EXR, ZIP compressed. 32-bit floats arrive bit for bit, in any order of the channels; 16-bit ones are
// rounded, and finite values stay so, but channels "id.*" stay 32-bit floats, which hold integers exactly. Like every
// function here, it needs memory for a few rows and returns what went wrong ("cannot write NAME: ..."), or an empty
// string.
std::string write_layers(const std::filesystem::path& path, const RowImage& image);
std::string write_layers(const std::filesystem::path& path, const LayeredImage& image);

// What an EXR says of one of its parts. Of the metadata those that are a string, int, float or double, which includes
// what EXR itself requires (compression, PixelAspectRatio ...); EXR does not keep their order.
struct ImagePart : ImageHeader {
  std::string name;   // empty: it has none
  bool deep = false;  // any number of values in each pixel, which is not supported

  bool covers_same_pixels(const ImageHeader& other) const;
};
struct PartsResult {
  std::vector<ImagePart> parts;  // at least one unless there is an error
  std::string error;
};
// Every part of an EXR, without its pixels.
PartsResult read_parts(const std::filesystem::path& path);

// Every channel of one part of an EXR as floats, with the part's metadata, and, if they are wanted, those of the other
// parts that cover the same pixels: under their own names if these name a layer, otherwise as "PART.NAME".
struct LayersResult {
  std::optional<LayeredImage> image;
  std::string error;
  std::string layer;        // of `image`, where one was chosen: what layer_rgb() wants
  bool is_picture = false;  // that layer is what is chosen when none is named
};
LayersResult read_layers(const std::filesystem::path& path, size_t part = 0, bool with_others = true);

// Writes linear Rec.709, three floats a pixel, rows from the top. By the path's ending: .png, .jpg and .jpeg hold
// 8 bits, values times 2^exposure through the sRGB curve, clamped; .hdr (negative values become 0, no other loss of
// range) and .pfm hold the values themselves, whatever the exposure. With `alpha` there are four values a pixel:
// colours that are not multiplied by it, and alpha, clamped to [0, 1]; of these files only .png holds it.
std::string write_rgb(const std::filesystem::path& path, int width, int height, const RowSource& rgb,
                      float exposure = 0, bool alpha = false);
// The same of an image in memory, with one alpha a pixel or none.
std::string write_rgb(const std::filesystem::path& path, int width, int height, std::span<const float> rgb,
                      float exposure = 0, std::span<const float> alpha = {});

// Whether an image could be written there: known ending, folder present and writable, and what encodes it loaded.
// Leaves an existing file as it is and nothing new behind. Returns what is wrong, or an empty string.
std::string check_output_path(const std::filesystem::path& path);

// Why no picture with alpha can be written there: the format has none. Empty for .png, and for .exr, which has layers.
std::string check_alpha_path(const std::filesystem::path& path);

// Whether the path's ending names the format that holds layers (.exr).
bool is_layered_path(const std::filesystem::path& path);

}  // namespace etd
