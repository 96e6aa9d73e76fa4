#include "io/image_write.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <new>

#include <fmt/format.h>

#include "io/oiio_setup.h"
#include "io/pending_file.h"
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

constexpr std::string_view kUnknownEnding = "an image file ends in .exr, .png, .jpg, .jpeg, .hdr or .pfm";

size_t texel_count(int width, int height) { return static_cast<size_t>(width) * static_cast<size_t>(height); }

std::string cannot_write(const fs::path& path, std::string why) {
  while (!why.empty() && why.back() == '\n') why.pop_back();
  return why.empty() ? why : fmt::format("cannot write {}: {}", path.string(), why);
}

// Encoders put their bytes here. They notice a full disk late, never, or by ending the process: so they are told that
// all went well, and the file knows what did not.
class FileProxy : public OIIO::Filesystem::IOProxy {
 public:
  FileProxy(const fs::path& path, PendingFile& file) : IOProxy(path.string(), Write), file_(file) {}
  const char* proxytype() const override { return "pending"; }
  bool seek(int64_t offset) override { return file_.seek(m_pos = offset), true; }
  size_t write(const void* bytes, size_t size) override {
    file_.write(bytes, size);
    m_pos += static_cast<int64_t>(size);
    end_ = std::max(end_, m_pos);
    return size;
  }
  size_t pwrite(const void* bytes, size_t size, int64_t offset) override {
    const int64_t back = m_pos;
    seek(offset);
    write(bytes, size);
    seek(back);
    return size;
  }
  size_t size() const override { return static_cast<size_t>(end_); }

 private:
  PendingFile& file_;
  int64_t end_ = 0;
};

// Encodes rows strip by strip; `value` makes what is stored out of each of their floats and its channel.
template <class Value>
std::string encode_rows(const fs::path& path, const OIIO::ImageSpec& spec, const RowSource& append_row, Value value) {
  using Stored = decltype(value(0.0f, size_t{}));
  constexpr int kStrip = 16;  // as many rows as EXR compresses together
  prepare_oiio();
  try {
    PendingFile file(path);
    if (!file.error().empty()) return cannot_write(path, file.error());
    FileProxy proxy(path, file);  // outlives the encoder, which may write when it is destroyed
    const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(path.string());
    if (out == nullptr) return cannot_write(path, OIIO::geterror());
    if (!out->set_ioproxy(&proxy) || !out->open(path.string(), spec)) return cannot_write(path, out->geterror());
    std::vector<float> rows;
    std::vector<Stored> stored;
    for (int begin = 0; begin < spec.height && file.error().empty(); begin += kStrip) {
      const int end = std::min(begin + kStrip, spec.height);
      rows.clear();
      for (int row = begin; row < end; ++row) append_row(row, rows);
      stored.resize(rows.size());
      for (size_t i = 0; i < rows.size(); ++i) stored[i] = value(rows[i], i % static_cast<size_t>(spec.nchannels));
      if (!out->write_scanlines(spec.y + begin, spec.y + end, 0, OIIO::BaseTypeFromC<Stored>::value, stored.data()))
        return cannot_write(path, out->geterror());
    }
    if (file.error().empty() && !out->close()) return cannot_write(path, out->geterror());
    return cannot_write(path, file.commit());
  } catch (const std::bad_alloc&) {
    return cannot_write(path, "out of memory");
  } catch (const std::exception& error) {
    return cannot_write(path, error.what());
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

std::string check_header(const ImageHeader& image) {
  if (image.width < 1 || image.height < 1 || image.full_width < 1 || image.full_height < 1) {
    return fmt::format("an image cannot have {} x {} of {} x {} pixels", image.width, image.height, image.full_width,
                       image.full_height);
  }
  if (image.channels.empty()) return "the image has no channels";
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

std::string write_8bit(const fs::path& path, int width, int height, const RowSource& rgb, float exposure, bool alpha) {
  OIIO::ImageSpec spec(width, height, alpha ? 4 : 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  if (alpha) spec.attribute("oiio:UnassociatedAlpha", 1);
  if (ending_of(path) != ".png") {
    spec.attribute("Compression", "jpeg:95");
    spec.attribute("jpeg:subsampling", "4:4:4");
  }
  return encode_rows(path, spec, rgb, [scale = std::exp2(exposure)](float v, size_t channel) -> uint8_t {
    if (channel < 3) return linear_to_srgb8(v * scale);
    return v > 0 ? static_cast<uint8_t>(255.0f * std::min(v, 1.0f) + 0.5f) : uint8_t{0};
  });
}

// Ids are integers that 16 bits do not hold.
bool is_id(std::string_view channel) { return channel.substr(0, 3) == "id."; }

// Finite values stay finite as 16-bit floats.
float within_half(float v) {
  constexpr float kLargest = 65504;
  return std::isfinite(v) ? std::clamp(v, -kLargest, kLargest) : v;
}

// Shared exponents hold neither negative numbers nor what is no number, and end at 2^127.
float within_shared_exponent(float v) {
  constexpr float kLargest = 0x1.fep126f;
  return v > 0 ? std::min(v, kLargest) : 0.0f;
}

std::string write_pfm(const fs::path& path, int width, int height, const RowSource& rgb) {
  PendingFile file(path);
  const std::string header = pfm_header(width, height);
  file.write(header.data(), header.size());
  std::vector<float> row;
  for (int y = height; y-- > 0 && file.error().empty();) {
    row.clear();
    rgb(y, row);
    const std::string bytes = pfm_row(row);
    file.write(bytes.data(), bytes.size());
  }
  return cannot_write(path, file.commit());
}

}  // namespace

int ImageHeader::find(std::string_view channel) const {
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

const MetadataValue* ImageHeader::find_metadata(std::string_view name) const {
  for (const auto& entry : metadata) {
    if (entry.first == name) return &entry.second;
  }
  return nullptr;
}

RowImage rows_of(const LayeredImage& image) {
  const size_t row_size = static_cast<size_t>(image.width) * image.channels.size();
  return {image, [&image, row_size](int row, std::vector<float>& to) {
            const auto begin = image.pixels.begin() + static_cast<std::ptrdiff_t>(static_cast<size_t>(row) * row_size);
            to.insert(to.end(), begin, begin + static_cast<std::ptrdiff_t>(row_size));
          }};
}

LayeredImage all_rows(const RowImage& image) {
  LayeredImage all{image, {}};
  all.pixels.reserve(texel_count(image.width, image.height) * image.channels.size());
  for (int row = 0; row < image.height; ++row) image.append_row(row, all.pixels);
  return all;
}

std::string write_layers(const fs::path& path, const RowImage& image) {
  if (!is_layered_path(path)) return cannot_write(path, "layers need a file that ends in .exr");
  if (std::string error = check_header(image); !error.empty()) return cannot_write(path, error);
  OIIO::ImageSpec spec(image.width, image.height, static_cast<int>(image.channels.size()),
                       image.half ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT);
  spec.x = image.x;
  spec.y = image.y;
  spec.full_width = image.full_width;
  spec.full_height = image.full_height;
  spec.channelnames = image.channels;
  spec.attribute("compression", "zip");
  for (const auto& [name, value] : image.metadata) add_metadata(spec, name, value);
  if (!image.half) return encode_rows(path, spec, image.append_row, [](float v, size_t) { return v; });
  for (const std::string& channel : image.channels)
    spec.channelformats.emplace_back(is_id(channel) ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::HALF);
  return encode_rows(path, spec, image.append_row,
                     [&image](float v, size_t channel) { return is_id(image.channels[channel]) ? v : within_half(v); });
}

std::string write_layers(const fs::path& path, const LayeredImage& image) {
  const size_t expected = texel_count(image.width, image.height) * image.channels.size();
  if (image.pixels.size() != expected)
    return cannot_write(path, fmt::format("{} values were given, {} expected", image.pixels.size(), expected));
  return write_layers(path, rows_of(image));
}

std::string write_rgb(const fs::path& path, int width, int height, const RowSource& rgb, float exposure, bool alpha) {
  const std::string ending = ending_of(path);
  if (const std::string problem = alpha ? check_alpha_path(path) : ""; !problem.empty())
    return cannot_write(path, problem);
  if (ending == ".png" || ending == ".jpg" || ending == ".jpeg")
    return write_8bit(path, width, height, rgb, exposure, alpha);
  if (ending == ".hdr")
    return encode_rows(path, OIIO::ImageSpec(width, height, 3, OIIO::TypeDesc::FLOAT), rgb,
                       [](float v, size_t) { return within_shared_exponent(v); });
  if (ending == ".pfm") return write_pfm(path, width, height, rgb);
  return cannot_write(path, std::string(kUnknownEnding));
}

std::string write_rgb(const fs::path& path, int width, int height, std::span<const float> rgb, float exposure,
                      std::span<const float> alpha) {
  const size_t texels = width < 1 || height < 1 ? 0 : texel_count(width, height);
  if (texels == 0 || rgb.size() != 3 * texels || (!alpha.empty() && alpha.size() != texels))
    return cannot_write(path, fmt::format("{} values do not make {} x {} RGB pixels", rgb.size(), width, height));
  const auto append = [&](int row, std::vector<float>& to) {
    const size_t first = static_cast<size_t>(row) * static_cast<size_t>(width);
    for (size_t i = first; i < first + static_cast<size_t>(width); ++i) {
      to.insert(to.end(), rgb.begin() + static_cast<std::ptrdiff_t>(3 * i),
                rgb.begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
      if (!alpha.empty()) to.push_back(alpha[i]);
    }
  };
  return write_rgb(path, width, height, append, exposure, !alpha.empty());
}

std::string check_output_path(const fs::path& path) {
  const std::string ending = ending_of(path);
  constexpr std::string_view kEndings[] = {".exr", ".png", ".jpg", ".jpeg", ".hdr", ".pfm"};
  if (std::find(std::begin(kEndings), std::end(kEndings), ending) == std::end(kEndings))
    return std::string(kUnknownEnding);
  return place_problem(path);
}

std::string check_alpha_path(const fs::path& path) {
  const std::string ending = ending_of(path);
  if (ending == ".png" || ending == ".exr") return {};
  return fmt::format("{} files have no alpha; .png has it, and .exr holds it as the layer foreground", ending);
}

bool is_layered_path(const fs::path& path) { return ending_of(path) == ".exr"; }

}  // namespace etd
