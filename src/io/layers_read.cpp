// Reads back every channel of a layered image with its windows and metadata, for comparing images and for tests.
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

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

LayersResult read_open_layers(OIIO::ImageInput& in) {
  const OIIO::ImageSpec spec = in.spec();
  constexpr int64_t kMostValues = int64_t{1} << 33;
  if (spec.width < 1 || spec.height < 1 || int64_t{spec.width} * spec.height > kMostValues / spec.nchannels) {
    return fail(fmt::format("it has {} x {} pixels of {} channels", spec.width, spec.height, spec.nchannels));
  }
  LayeredImage image;
  image.width = spec.width, image.height = spec.height;
  image.x = spec.x - spec.full_x, image.y = spec.y - spec.full_y;
  image.full_width = spec.full_width, image.full_height = spec.full_height;
  image.channels = spec.channelnames;
  image.pixels.resize(static_cast<size_t>(spec.width) * static_cast<size_t>(spec.height) *
                      static_cast<size_t>(spec.nchannels));
  const bool good = in.read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.pixels.data());
  std::string error = in.geterror();
  if (!good || !error.empty()) return fail(std::move(error));
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
