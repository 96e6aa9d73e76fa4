#include "io/picture.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "io/image.h"
#include "params/diagnostics.h"

namespace etd {
namespace {

// The part of a channel's name before the last dot; empty for the image's own.
std::string_view layer_of(std::string_view channel) {
  const size_t dot = channel.rfind('.');
  return dot == std::string_view::npos ? std::string_view() : channel.substr(0, dot);
}

// The indices of the channels that show a layer; empty when they make no picture.
std::vector<int> picture_channels(const LayeredImage& image, std::string_view name) {
  std::vector<PartLayer> layers;
  add_layers(0, {}, image.channels, layers);
  const auto layer = std::find_if(layers.begin(), layers.end(), [&](const PartLayer& l) { return l.prefix == name; });
  if (layer == layers.end()) return {};
  using Names = std::array<const char*, 3>;
  for (const Names& names : {Names{"R", "G", "B"}, Names{"X", "Y", "Z"}}) {
    std::vector<int> found;
    for (const char* n : names)
      if (const int i = layer->find(n); i >= 0) found.push_back(i);
    if (found.size() == 3) return found;
  }
  if (layer->channels.size() == 1) return std::vector<int>(3, layer->channels[0]);
  // Grey with alpha; other channels beside Y may be its chroma.
  const int y = layer->find("Y");
  if (layer->channels.size() == 2 && y >= 0 && layer->find("A") >= 0) return std::vector<int>(3, y);
  return {};
}

std::string no_such_layer(const LayeredImage& image, std::string_view layer) {
  std::vector<std::string_view> layers;
  for (const std::string& channel : image.channels)
    if (const std::string_view name = layer_of(channel);
        !name.empty() && std::find(layers.begin(), layers.end(), name) == layers.end())
      layers.push_back(name);
  if (std::find(layers.begin(), layers.end(), layer) != layers.end() || layer.empty())
    return fmt::format("{} has not the channels of a picture, but {}",
                       layer.empty() ? "the image" : fmt::format("the layer \"{}\"", layer),
                       fmt::join(image.channels, ", "));
  std::string text = fmt::format("there is no layer \"{}\"", layer);
  if (const std::string_view near = nearest_name(layer, layers); !near.empty())
    text += fmt::format("\n  did you mean \"{}\"?", near);
  return text + (layers.empty() ? "\n  the file has no layers" : fmt::format("\n  valid: {}", fmt::join(layers, ", ")));
}

// What to add to an error of choose_layer().
std::string naming_hint(const std::vector<PartLayer>& layers, const std::string& layer) {
  if (layer.empty()) return "\n  --layer NAME says which one to take";
  std::vector<std::string_view> names;
  for (const PartLayer& l : layers) {
    if (l.is_called(layer)) return "\n  PART.LAYER says which one to take";
    for (const std::string* name : {&l.prefix, &l.part_name})
      if (!name->empty()) names.push_back(*name);
  }
  const std::string_view near = nearest_name(layer, names);
  return near.empty() ? std::string() : fmt::format("\n  did you mean \"{}\"?", near);
}

LayersResult read_chosen_layers(const std::filesystem::path& path, const std::string& layer) {
  const PartsResult read = read_parts(path);
  if (!read.error.empty()) return {{}, read.error, {}, false};
  std::vector<PartLayer> layers;
  const LayerChoice chosen = choose_picture(read.parts, layers, layer);
  if (!chosen.layer) return {{}, chosen.error + naming_hint(layers, layer), {}, false};
  const bool is_picture = layer.empty() || choose_layer(layers, {}).layer == chosen.layer;
  LayersResult result = read_layers(path, static_cast<size_t>(chosen.layer->part), is_picture);
  result.layer = chosen.layer->prefix;
  result.is_picture = is_picture;
  return result;
}

}  // namespace

LayerChoice choose_picture(const std::vector<ImagePart>& parts, std::vector<PartLayer>& layers,
                           const std::string& layer) {
  layers.clear();
  for (size_t i = 0; i < parts.size(); ++i) add_layers(static_cast<int>(i), parts[i].name, parts[i].channels, layers);
  return choose_layer(layers, layer);
}

LayersResult read_any_layers(const std::filesystem::path& path, const std::string& layer) {
  if (is_layered_path(path)) return read_chosen_layers(path, layer);
  const ImageResult read = read_image(path);
  if (!read.image) return {{}, read.error, {}, false};
  const Image& from = *read.image;
  LayeredImage image;
  image.width = image.full_width = from.width();
  image.height = image.full_height = from.height();
  image.channels = {"R", "G", "B"};
  image.pixels.reserve(3 * static_cast<size_t>(from.width()) * static_cast<size_t>(from.height()));
  for (int y = 0; y < from.height(); ++y)
    for (int x = 0; x < from.width(); ++x)
      for (int c = 0; c < 3; ++c) image.pixels.push_back(from.texel(x, y, from.channels() == 1 ? 0 : c));
  return {std::move(image), {}, layer, layer.empty()};
}

LayerResult layer_rgb(const LayeredImage& image, std::string_view layer) {
  LayerResult result;
  const std::vector<int> channels = picture_channels(image, layer);
  if (channels.empty()) {
    result.error = no_such_layer(image, layer);
    return result;
  }
  const size_t step = image.channels.size();
  result.rgb.reserve(image.pixels.size() / step * 3);
  for (size_t pixel = 0; pixel < image.pixels.size(); pixel += step)
    for (const int c : channels) result.rgb.push_back(image.pixels[pixel + static_cast<size_t>(c)]);
  return result;
}

Picture crop(const Picture& picture, const PixelBounds& b) {
  Picture part{b.width(), b.height(), {}};
  part.rgb.reserve(3 * part.pixels());
  for (int y = b.y0; y < b.y1; ++y) {
    const auto row = picture.rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(y) * picture.width + b.x0);
    part.rgb.insert(part.rgb.end(), row, row + 3 * static_cast<std::ptrdiff_t>(b.width()));
  }
  return part;
}

}  // namespace etd
