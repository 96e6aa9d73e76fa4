#include "io/cut_out.h"

#include <fmt/format.h>

#include <array>

namespace etd {
namespace {

// The channels of a picture and of its alpha; -1 for those that the image has not.
using Channels = std::array<int, 4>;

Channels find_channels(const LayeredImage& image, const std::string& layer, const char* alpha) {
  return {image.find(layer + "R"), image.find(layer + "G"), image.find(layer + "B"), image.find(alpha)};
}

bool complete(const Channels& channels) {
  return channels[0] >= 0 && channels[1] >= 0 && channels[2] >= 0 && channels[3] >= 0;
}

CutOut take(const LayeredImage& image, const Channels& channels) {
  CutOut result;
  const size_t step = image.channels.size(), pixels = image.pixels.size() / step;
  result.rgb.reserve(3 * pixels);
  result.alpha.reserve(pixels);
  for (size_t i = 0; i < image.pixels.size(); i += step) {
    for (size_t c = 0; c < 3; ++c) result.rgb.push_back(image.pixels[i + static_cast<size_t>(channels[c])]);
    result.alpha.push_back(image.pixels[i + static_cast<size_t>(channels[3])]);
  }
  return result;
}

// Takes the emission out of pixels that are not covered as a whole, if pixels that are not covered at all have any.
void take_out_background(const CutOut& emission, CutOut& picture) {
  bool shines = false;
  for (size_t i = 0; i < picture.rgb.size(); ++i) shines = shines || (picture.alpha[i / 3] == 0 && emission.rgb[i] > 0);
  for (size_t i = 0; shines && i < picture.rgb.size(); ++i)
    if (picture.alpha[i / 3] < 1) picture.rgb[i] -= emission.rgb[i];
}

}  // namespace

CutOut cut_out(const LayeredImage& image) {
  for (const Channels& channels : {find_channels(image, "foreground.", "foreground.A"), find_channels(image, "", "A")})
    if (complete(channels)) return take(image, channels);
  const Channels picture = find_channels(image, "", "coverage.A"),
                 emission = find_channels(image, "emission.", "coverage.A");
  CutOut result;
  if (!complete(picture) || !complete(emission)) {
    result.error = "it has no alpha: neither a layer foreground (render --alpha) nor a channel A";
    return result;
  }
  result = take(image, picture);
  take_out_background(take(image, emission), result);
  result.note =
      "it was rendered without --alpha, so coverage is taken for alpha: mirrors and clear glass are missing where they "
      "show the background, and lamps have dark edges before a bright one";
  return result;
}

CutOut cut_out_layer(const LayeredImage& image, const std::string& layer) {
  const std::string prefix = layer.empty() ? std::string() : layer + ".";
  const Channels channels = find_channels(image, prefix, (prefix + "A").c_str());
  if (complete(channels)) return take(image, channels);
  CutOut result;
  result.error = fmt::format("the layer \"{}\" has no alpha: channels R, G, B and A of its own", layer);
  return result;
}

void divide_by_alpha(CutOut& picture) {
  for (size_t i = 0; i < picture.rgb.size(); ++i) {
    const float alpha = picture.alpha[i / 3];
    picture.rgb[i] = alpha > 0 ? picture.rgb[i] / alpha : 0.0f;
  }
}

}  // namespace etd
