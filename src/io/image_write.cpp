#include "io/image_write.h"

#include <algorithm>
#include <new>

#include <fmt/format.h>

#include "io/image_codecs.h"
#include "io/pending_file.h"
#include "io/pfm.h"

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

// Returns what went wrong when `f` wrote with the codecs, or an empty string.
template <class F>
std::string encode(const fs::path& path, F&& f) {
  try {
    return cannot_write(path, f(image_codecs()));
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
  return encode(path, [&](const ImageCodecs& codecs) { return codecs.write_exr(path, image); });
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
    return encode(path, [&](const ImageCodecs& codecs) {
      return codecs.write_8bit(path, width, height, rgb, exposure, alpha, ending != ".png");
    });
  if (ending == ".hdr")
    return encode(path, [&](const ImageCodecs& codecs) { return codecs.write_hdr(path, width, height, rgb); });
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
  if (ending != ".pfm") {
    try {
      image_codecs();  // now, while there is memory for it
    } catch (const std::exception& error) {
      return error.what();
    }
  }
  return place_problem(path);
}

std::string check_alpha_path(const fs::path& path) {
  const std::string ending = ending_of(path);
  if (ending == ".png" || ending == ".exr") return {};
  return fmt::format("{} files have no alpha; .png has it, and .exr holds it as the layer foreground", ending);
}

bool is_layered_path(const fs::path& path) { return ending_of(path) == ".exr"; }

}  // namespace etd
