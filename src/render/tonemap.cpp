#include "render/tonemap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "params/diagnostics.h"
#include "spectrum/color_space.h"

namespace etd {
namespace {

double filmic(double x) { return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14); }

double on_screen(double x, ToneOperator curve) {
  x = std::max(x, 0.0);
  return std::min(curve == ToneOperator::kFilmic ? filmic(x) : x, 1.0);
}

// The part of a channel's name before the last dot; empty for the image's own.
std::string_view layer_of(std::string_view channel) {
  const size_t dot = channel.rfind('.');
  return dot == std::string_view::npos ? std::string_view() : channel.substr(0, dot);
}

// The indices of the channels that show a layer; empty when they make no picture.
std::vector<int> picture_channels(const LayeredImage& image, std::string_view layer) {
  const std::string prefix = layer.empty() ? std::string() : std::string(layer) + ".";
  using Names = std::array<const char*, 3>;
  for (const Names& names : {Names{"R", "G", "B"}, Names{"X", "Y", "Z"}}) {
    std::vector<int> found;
    for (const char* name : names)
      if (const int i = image.find(prefix + name); i >= 0) found.push_back(i);
    if (found.size() == 3) return found;
  }
  std::vector<int> all;
  for (size_t i = 0; i < image.channels.size(); ++i)
    if (layer_of(image.channels[i]) == layer) all.push_back(static_cast<int>(i));
  if (all.size() != 1) return {};
  return {all[0], all[0], all[0]};
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

}  // namespace

size_t tone_map(std::span<float> rgb, const ToneMapping& mapping) {
  constexpr double kBrightest = 1e9;  // also for infinite values: more than any screen shows, and it can be multiplied
  const double scale = std::exp2(mapping.exposure);
  size_t not_numbers = 0;
  for (size_t i = 0; i + 2 < rgb.size(); i += 3) {
    if (std::isnan(rgb[i]) || std::isnan(rgb[i + 1]) || std::isnan(rgb[i + 2])) {
      ++not_numbers;
      std::fill_n(rgb.begin() + static_cast<std::ptrdiff_t>(i), 3, 0.0f);
      continue;
    }
    const auto bounded = [&](size_t c) { return std::clamp<double>(rgb[i + c], -kBrightest, kBrightest); };
    Vec3d v{bounded(0), bounded(1), bounded(2)};
    if (const auto& m = mapping.balance) v = {dot((*m)[0], v), dot((*m)[1], v), dot((*m)[2], v)};
    rgb[i] = static_cast<float>(on_screen(v.x * scale, mapping.curve));
    rgb[i + 1] = static_cast<float>(on_screen(v.y * scale, mapping.curve));
    rgb[i + 2] = static_cast<float>(on_screen(v.z * scale, mapping.curve));
  }
  return not_numbers;
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

std::optional<std::array<Vec3d, 3>> grey_world_balance(std::span<const float> rgb) {
  Vec3d sum{0, 0, 0};
  for (size_t i = 0; i + 2 < rgb.size(); i += 3) {
    const Vec3d v{rgb[i], rgb[i + 1], rgb[i + 2]};
    if (std::isfinite(v.x + v.y + v.z)) sum = sum + v;
  }
  const bool is_colour = sum.x >= 0 && sum.y >= 0 && sum.z >= 0 && sum.x + sum.y + sum.z > 0;
  if (!is_colour) return {};
  return adapt_rec709(rec709_to_xyz(sum));
}

}  // namespace etd
