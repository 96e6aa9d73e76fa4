// Reads back every channel of a layered image with its windows and metadata, for comparing images and for tests: of one
// part of an EXR file, or of all of them.
#include <OpenImageIO/imageio.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

#include "io/codecs/codecs.h"
#include "io/codecs/image_channels.h"
#include "io/codecs/oiio_setup.h"

namespace etd {
namespace {

LayersResult fail(std::string error) {
  while (!error.empty() && error.back() == '\n') error.pop_back();
  LayersResult result;
  result.error = error.empty() ? "it could not be read" : std::move(error);
  return result;
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
std::string read_pixels(OIIO::ImageInput& in, int part, const OIIO::ImageSpec& spec, std::vector<float>& pixels) {
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
        tiled ? in.read_tiles(part, 0, spec.x, spec.x + spec.width, begin, end, spec.z, spec.z + 1, 0, spec.nchannels,
                              OIIO::TypeDesc::FLOAT, &pixels[at])
              : in.read_scanlines(part, 0, begin, end, spec.z, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, &pixels[at]);
    if (std::string error = in.geterror(); !good || !error.empty())
      return error.empty() ? "its pixels could not be read" : error;
  }
  return {};
}

ImagePart part_of(const OIIO::ImageSpec& spec) {
  ImagePart part;
  part.name = spec.get_string_attribute("oiio:subimagename");
  part.deep = spec.deep;
  part.width = spec.width, part.height = spec.height;
  part.x = spec.x - spec.full_x, part.y = spec.y - spec.full_y;
  part.full_width = spec.full_width, part.full_height = spec.full_height;
  part.channels = spec.channelnames;
  for (const OIIO::ParamValue& attribute : spec.extra_attribs) {
    if (std::optional<MetadataValue> value = metadata_value(attribute)) {
      part.metadata.emplace_back(attribute.name().string(), std::move(*value));
    }
  }
  return part;
}

std::vector<ImagePart> parts_of(OIIO::ImageInput& in) {
  std::vector<ImagePart> parts;
  for (int i = 0; i < kMostParts && in.seek_subimage(i, 0); ++i) parts.push_back(part_of(in.spec()));
  in.geterror();  // of looking behind the last one
  return parts;
}

// The name in an image of several parts of a channel that is none of the main part's.
std::string name_among_parts(const ImagePart& part, const std::string& channel, const std::vector<std::string>& taken) {
  const bool has_layer = channel.find('.') != std::string::npos;
  const bool is_free = std::find(taken.begin(), taken.end(), channel) == taken.end();
  return has_layer && is_free ? channel : part.name + "." + channel;
}

// Appends the channels of one image to each pixel of another.
void append_channels(LayeredImage& to, const std::vector<std::string>& channels, const std::vector<float>& pixels) {
  const size_t a = to.channels.size(), b = channels.size(), count = b == 0 ? 0 : pixels.size() / b;
  std::vector<float> all;
  all.reserve(count * (a + b));
  for (size_t i = 0; i < count; ++i) {
    all.insert(all.end(), &to.pixels[i * a], &to.pixels[i * a] + a);
    all.insert(all.end(), &pixels[i * b], &pixels[i * b] + b);
  }
  to.pixels = std::move(all);
  to.channels.insert(to.channels.end(), channels.begin(), channels.end());
}

// Returns what went wrong, or an empty string.
std::string append_part(OIIO::ImageInput& in, size_t index, const ImagePart& part, LayeredImage& image) {
  const int i = static_cast<int>(index);
  if (!in.seek_subimage(i, 0)) return "one of its parts could not be read";
  std::vector<float> pixels;
  if (std::string error = read_pixels(in, i, in.spec(), pixels); !error.empty()) return error;
  if (image.channels.empty()) {
    image.channels = part.channels;
    image.pixels = std::move(pixels);
    return {};
  }
  std::vector<std::string> names;
  for (const std::string& channel : part.channels) names.push_back(name_among_parts(part, channel, image.channels));
  append_channels(image, names, pixels);
  return {};
}

LayersResult read_open_layers(OIIO::ImageInput& in, size_t main, bool with_others) {
  const std::vector<ImagePart> parts = parts_of(in);
  if (main >= parts.size()) return fail("one of its parts could not be read");
  const ImagePart& part = parts[main];
  if (part.deep) return fail("its pixels are deep, with any number of values in each, which is not supported");
  std::vector<size_t> wanted{main};
  for (size_t i = 0; with_others && i < parts.size(); ++i)
    if (i != main && !parts[i].deep && parts[i].covers_same_pixels(part)) wanted.push_back(i);
  size_t channels = 0;
  for (const size_t i : wanted) channels += parts[i].channels.size();
  const double bytes = 4.0 * part.width * part.height * static_cast<double>(channels), present = present_bytes();
  if (part.width < 1 || part.height < 1 || bytes > present) {
    return fail(fmt::format("it has {} x {} pixels of {} channels, for which the machine's {:.1f} GiB are too few",
                            part.width, part.height, channels, present / (1u << 30)));
  }
  LayeredImage image;
  static_cast<ImageHeader&>(image) = part;
  image.channels.clear();
  for (const size_t i : wanted)
    if (std::string error = append_part(in, i, parts[i], image); !error.empty()) return fail(std::move(error));
  return {std::move(image), {}, {}, false};
}

// Calls f with the opened file. Returns what went wrong, or an empty string.
template <class F>
std::string with_open_exr(const std::filesystem::path& path, const F& f) {
  prepare_oiio();
  std::string error;
  try {
    const std::unique_ptr<OIIO::ImageInput> in = OIIO::ImageInput::open(path.string());
    if (in != nullptr) {
      f(*in);
      return {};
    }
    error = OIIO::geterror();
  } catch (const std::exception& e) {
    error = e.what();
  }
  return fail(std::move(error)).error;
}

}  // namespace

PartsResult OiioCodecs::read_parts(const std::filesystem::path& path) const {
  PartsResult result;
  result.error = with_open_exr(path, [&](OIIO::ImageInput& in) { result.parts = parts_of(in); });
  if (result.error.empty() && result.parts.empty()) result.error = "it could not be read";
  return result;
}

LayersResult OiioCodecs::read_layers(const std::filesystem::path& path, size_t part, bool with_others) const {
  LayersResult result;
  std::string error =
      with_open_exr(path, [&](OIIO::ImageInput& in) { result = read_open_layers(in, part, with_others); });
  if (!error.empty()) return fail(std::move(error));
  return result;
}

}  // namespace etd
