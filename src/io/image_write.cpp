#include "io/image_write.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "io/file.h"
#include "io/oiio_setup.h"
#include "io/pfm.h"
#include "spectrum/srgb.h"

namespace etd {
namespace {

namespace fs = std::filesystem;

std::string ending_of(const fs::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return ending;
}

std::string unknown_ending(const fs::path& path) {
  return fmt::format("{}: an image file ends in .exr, .png, .jpg, .jpeg, .hdr or .pfm", path.string());
}

size_t texel_count(int width, int height) { return static_cast<size_t>(width) * static_cast<size_t>(height); }

// Encodes in memory and writes the bytes ourselves: the encoders notice a full disk late, never, or by ending the
// process.
std::string encode_and_write(const fs::path& path, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                             const void* pixels) {
  prepare_oiio();
  const auto failed = [&path](std::string why) {
    while (!why.empty() && why.back() == '\n') why.pop_back();
    return fmt::format("cannot write {}: {}", path.string(), why);
  };
  try {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);  // outlives the encoder, which may write when it is destroyed
    const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(path.string());
    if (out == nullptr) return failed(OIIO::geterror());
    if (!out->set_ioproxy(&memory) || !out->open(path.string(), spec) || !out->write_image(type, pixels) ||
        !out->close()) {
      return failed(out->geterror());
    }
    return write_file(path, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  } catch (const std::exception& error) {
    return failed(error.what());
  }
}

// Names that EXR keeps for itself; other values under them make a file that readers refuse.
bool is_reserved(std::string_view name) {
  constexpr std::string_view kReserved[] = {"channels",
                                            "chunkCount",
                                            "compression",
                                            "dataWindow",
                                            "displayWindow",
                                            "lineOrder",
                                            "name",
                                            "pixelAspectRatio",
                                            "screenWindowCenter",
                                            "screenWindowWidth",
                                            "tiles",
                                            "type",
                                            "version",
                                            "view"};
  return std::find(std::begin(kReserved), std::end(kReserved), name) != std::end(kReserved);
}

std::string check_layers(const LayeredImage& image) {
  if (image.width < 1 || image.height < 1 || image.full_width < 1 || image.full_height < 1) {
    return fmt::format("an image cannot have {} x {} of {} x {} pixels", image.width, image.height, image.full_width,
                       image.full_height);
  }
  if (image.channels.empty()) return "the image has no channels";
  const size_t expected = texel_count(image.width, image.height) * image.channels.size();
  if (image.pixels.size() != expected) {
    return fmt::format("{} values were given, {} expected", image.pixels.size(), expected);
  }
  std::vector<std::string> names = image.channels;
  std::sort(names.begin(), names.end());
  if (const auto twice = std::adjacent_find(names.begin(), names.end()); twice != names.end()) {
    return fmt::format("two channels are named {}", *twice);
  }
  for (const auto& [name, value] : image.metadata) {
    if (is_reserved(name)) return fmt::format("metadata cannot be named {}: the EXR format uses the name", name);
  }
  return {};
}

void add_metadata(OIIO::ImageSpec& spec, const std::string& name, const MetadataValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) spec.attribute(name, *text);
  if (const auto* number = std::get_if<int>(&value)) spec.attribute(name, *number);
  if (const auto* number = std::get_if<float>(&value)) spec.attribute(name, *number);
  if (const auto* number = std::get_if<double>(&value))
    spec.attribute(name, OIIO::TypeDesc(OIIO::TypeDesc::DOUBLE), number);
}

std::string write_8bit(const fs::path& path, int width, int height, std::span<const float> rgb, float exposure) {
  const float scale = std::exp2(exposure);
  std::vector<uint8_t> bytes(rgb.size());
  std::transform(rgb.begin(), rgb.end(), bytes.begin(), [scale](float v) { return linear_to_srgb8(v * scale); });
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  if (ending_of(path) != ".png") {
    spec.attribute("Compression", "jpeg:95");
    spec.attribute("jpeg:subsampling", "4:4:4");
  }
  return encode_and_write(path, spec, spec.format, bytes.data());
}

// Finite values stay finite as 16-bit floats.
std::vector<float> within_half(std::vector<float> values) {
  constexpr float kLargest = 65504;
  for (float& v : values)
    if (std::isfinite(v)) v = std::clamp(v, -kLargest, kLargest);
  return values;
}

// Shared exponents hold neither negative numbers nor what is no number, and end at 2^127.
std::string write_hdr(const fs::path& path, int width, int height, std::span<const float> rgb) {
  static constexpr float kLargest = 0x1.fep126f;
  std::vector<float> values(rgb.size());
  std::transform(rgb.begin(), rgb.end(), values.begin(), [](float v) { return v > 0 ? std::min(v, kLargest) : 0.0f; });
  const OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::FLOAT);
  return encode_and_write(path, spec, spec.format, values.data());
}

}  // namespace

int LayeredImage::find(std::string_view channel) const {
  const auto found = std::find(channels.begin(), channels.end(), channel);
  return found == channels.end() ? -1 : static_cast<int>(found - channels.begin());
}

std::vector<float> LayeredImage::plane(std::string_view channel) const {
  std::vector<float> values;
  const int index = find(channel);
  if (index < 0) return values;
  values.reserve(texel_count(width, height));
  for (size_t i = static_cast<size_t>(index); i < pixels.size(); i += channels.size()) values.push_back(pixels[i]);
  return values;
}

const MetadataValue* LayeredImage::find_metadata(std::string_view name) const {
  for (const auto& entry : metadata) {
    if (entry.first == name) return &entry.second;
  }
  return nullptr;
}

std::string write_layers(const fs::path& path, const LayeredImage& image) {
  if (!is_layered_path(path)) return fmt::format("{}: layers need a file that ends in .exr", path.string());
  if (std::string error = check_layers(image); !error.empty()) {
    return fmt::format("cannot write {}: {}", path.string(), error);
  }
  OIIO::ImageSpec spec(image.width, image.height, static_cast<int>(image.channels.size()),
                       image.half ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT);
  spec.x = image.x;
  spec.y = image.y;
  spec.full_width = image.full_width;
  spec.full_height = image.full_height;
  spec.channelnames = image.channels;
  spec.attribute("compression", "zip");
  for (const auto& [name, value] : image.metadata) add_metadata(spec, name, value);
  const OIIO::TypeDesc given(OIIO::TypeDesc::FLOAT);
  return image.half ? encode_and_write(path, spec, given, within_half(image.pixels).data())
                    : encode_and_write(path, spec, given, image.pixels.data());
}

std::string write_rgb(const fs::path& path, int width, int height, std::span<const float> rgb, float exposure) {
  if (width < 1 || height < 1 || rgb.size() != 3 * texel_count(width, height)) {
    return fmt::format("cannot write {}: {} values do not make {} x {} RGB pixels", path.string(), rgb.size(), width,
                       height);
  }
  const std::string ending = ending_of(path);
  if (ending == ".png" || ending == ".jpg" || ending == ".jpeg") return write_8bit(path, width, height, rgb, exposure);
  if (ending == ".hdr") return write_hdr(path, width, height, rgb);
  if (ending == ".pfm") return write_file(path, encode_pfm(width, height, rgb));
  return unknown_ending(path);
}

std::string check_output_path(const fs::path& path) {
  const std::string ending = ending_of(path);
  constexpr std::string_view kEndings[] = {".exr", ".png", ".jpg", ".jpeg", ".hdr", ".pfm"};
  if (std::find(std::begin(kEndings), std::end(kEndings), ending) == std::end(kEndings)) return unknown_ending(path);
  std::error_code ignored;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::exists(folder, ignored)) return fmt::format("the folder {} does not exist", folder.string());
  if (!fs::is_directory(folder, ignored)) return fmt::format("{} is not a folder", folder.string());
  if (fs::exists(path, ignored)) {
    if (!fs::is_regular_file(path, ignored)) return fmt::format("{} is not a file that can be replaced", path.string());
    if (::access(path.c_str(), W_OK) != 0) return fmt::format("{} is write-protected", path.string());
  }
  return PendingFile(path).error();
}

bool is_layered_path(const fs::path& path) { return ending_of(path) == ".exr"; }

}  // namespace etd
