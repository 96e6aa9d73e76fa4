// Reads back every channel of a layered image with its windows and metadata, for comparing images and for tests.
#include <OpenImageIO/imageio.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

#include "io/image_limits.h"
#include "io/image_write.h"
#include "io/oiio_setup.h"

namespace etd {
namespace {

LayersResult fail(std::string error) {
  while (!error.empty() && error.back() == '\n') error.pop_back();
  return {std::nullopt, error.empty() ? "it could not be read" : std::move(error)};
}

std::optional<MetadataValue> metadata_value(const OIIO::ParamValue& attribute) {
  const OIIO::TypeDesc type = attribute.type();
  if (type == OIIO::TypeDesc::STRING) return MetadataValue(attribute.get_string());
  if (type == OIIO::TypeDesc::INT) return MetadataValue(attribute.get_int());
  if (type == OIIO::TypeDesc::FLOAT) return MetadataValue(attribute.get_float());
  if (type == OIIO::TypeDesc::DOUBLE) return MetadataValue(*static_cast<const double*>(attribute.data()));
  return std::nullopt;
}

double present_bytes() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

// Reads a band of rows at a time, so that a header that promises more than the file holds fails before the memory for
// it is touched. Returns what went wrong, or an empty string.
std::string read_pixels(OIIO::ImageInput& in, const OIIO::ImageSpec& spec, std::vector<float>& pixels) {
  constexpr int kRows = 256;
  const bool tiled = spec.tile_width > 0;
  const int band = tiled ? std::max(spec.tile_height, kRows / spec.tile_height * spec.tile_height) : kRows;
  const size_t row = static_cast<size_t>(spec.width) * static_cast<size_t>(spec.nchannels);
  pixels.reserve(row * static_cast<size_t>(spec.height));
  for (int y = 0; y < spec.height; y += band) {
    const int count = std::min(band, spec.height - y), begin = spec.y + y, end = begin + count;
    const size_t at = pixels.size();
    pixels.resize(at + row * static_cast<size_t>(count));
    const bool good =
        tiled ? in.read_tiles(0, 0, spec.x, spec.x + spec.width, begin, end, spec.z, spec.z + 1, 0, spec.nchannels,
                              OIIO::TypeDesc::FLOAT, &pixels[at])
              : in.read_scanlines(0, 0, begin, end, spec.z, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, &pixels[at]);
    if (std::string error = in.geterror(); !good || !error.empty())
      return error.empty() ? "its pixels could not be read" : error;
  }
  return {};
}

LayersResult read_open_layers(OIIO::ImageInput& in) {
  const OIIO::ImageSpec spec = in.spec();
  const double bytes = 4.0 * spec.width * spec.height * spec.nchannels, present = present_bytes();
  if (spec.width < 1 || spec.height < 1 || bytes > present) {
    return fail(fmt::format("it has {} x {} pixels of {} channels, for which the machine's {:.1f} GiB are too few",
                            spec.width, spec.height, spec.nchannels, present / (1u << 30)));
  }
  LayeredImage image;
  image.width = spec.width, image.height = spec.height;
  image.x = spec.x - spec.full_x, image.y = spec.y - spec.full_y;
  image.full_width = spec.full_width, image.full_height = spec.full_height;
  image.channels = spec.channelnames;
  if (std::string error = read_pixels(in, spec, image.pixels); !error.empty()) return fail(std::move(error));
  for (const OIIO::ParamValue& attribute : spec.extra_attribs) {
    if (std::optional<MetadataValue> value = metadata_value(attribute)) {
      image.metadata.emplace_back(attribute.name().string(), std::move(*value));
    }
  }
  return {std::move(image), {}};
}

}  // namespace

LayersResult read_layers(const std::filesystem::path& path) {
  if (!is_layered_path(path)) return fail("layers are read from .exr files only");
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return fail("the file does not exist");
  if (std::string error = image_header_problem(path, {}); !error.empty()) return fail(std::move(error));
  prepare_oiio();
  try {
    const std::unique_ptr<OIIO::ImageInput> in = OIIO::ImageInput::open(path.string());
    if (in == nullptr) return fail(OIIO::geterror());
    return read_open_layers(*in);
  } catch (const std::exception& error) {
    return fail(error.what());
  }
}

}  // namespace etd
