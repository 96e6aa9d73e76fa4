#include "io/codecs/image_channels.h"

#include <fmt/format.h>

#include "io/layer_choice.h"

namespace etd {
namespace {

std::vector<PartLayer> layers_of(OIIO::ImageInput& in, int parts) {
  std::vector<PartLayer> layers;
  for (int part = 0; part < parts && in.seek_subimage(part, 0); ++part) {
    const OIIO::ImageSpec spec = in.spec();
    add_layers(part, spec.get_string_attribute("oiio:subimagename"), spec.channelnames, layers);
  }
  return layers;
}

ChannelChoice channels_of(const PartLayer& layer) {
  ChannelChoice choice;
  choice.part = layer.part;
  const int y = layer.find("Y"), ry = layer.find("RY"), by = layer.find("BY"), a = layer.find("A");
  if (layer.has_rgb()) {
    choice.of_file = {layer.find("R"), layer.find("G"), layer.find("B")};
  } else if (layer.channels.size() == 1) {
    choice.of_file = {layer.channels[0]};
    return choice;
  } else if (y >= 0 && ry >= 0 && by >= 0) {
    choice.of_file = {y, ry, by};
    choice.luminance_chroma = true;
  } else if (y >= 0) {
    choice.of_file = {y};
    if (a >= 0) choice.of_file = {y, y, y};
  } else {
    choice.error = fmt::format("it has the channels {}: expected R, G, B or one channel", fmt::join(layer.names, ", "));
    return choice;
  }
  if (a >= 0) choice.of_file.push_back(a);
  return choice;
}

ChannelChoice choose(const std::vector<PartLayer>& layers, const std::string& name) {
  LayerChoice found = choose_layer(layers, name);
  if (found.layer) return channels_of(*found.layer);
  ChannelChoice choice;
  choice.error = std::move(found.error);
  choice.needs_name = true;
  return choice;
}

}  // namespace

ChannelChoice choose_channels(OIIO::ImageInput& in, const std::string& layer) {
  // Other formats have frames, pages and thumbnails, of which the first is the image.
  const bool has_parts = std::string_view(in.format_name()) == "openexr";
  const std::vector<PartLayer> layers = layers_of(in, has_parts ? kMostParts : 1);
  const bool has_more = !has_parts && std::string_view(in.format_name()) != "psd" && in.seek_subimage(1, 0);
  ChannelChoice choice = choose(layers, layer);
  if (has_more) choice.note = "it holds several images, of which the first is taken";
  in.geterror();  // of looking behind the last one
  if (choice.error.empty() && !in.seek_subimage(choice.part, 0)) choice.error = "its part could not be read";
  return choice;
}

void luminance_chroma_to_rgb(float* texel) {
  constexpr float kR = 0.212639f, kG = 0.715169f, kB = 0.072192f;
  const float y = texel[0], r = (texel[1] + 1) * y, b = (texel[2] + 1) * y;
  texel[0] = r, texel[1] = (y - kR * r - kB * b) / kG, texel[2] = b;
}

}  // namespace etd
