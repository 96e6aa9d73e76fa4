#include "io/image_channels.h"

#include <OpenImageIO/strutil.h>

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "io/file.h"

namespace etd {
namespace {

// Channels of one part whose names agree up to the last dot.
struct Layer {
  int part = 0;
  std::string part_name, prefix;
  std::vector<int> channels;
  std::vector<std::string> names;  // behind the prefix

  int find(std::string_view name) const {
    for (size_t i = 0; i < names.size(); ++i)
      if (OIIO::Strutil::iequals(names[i], OIIO::string_view(name.data(), name.size()))) return channels[i];
    return -1;
  }
  bool has_rgb() const { return find("R") >= 0 && find("G") >= 0 && find("B") >= 0; }
  bool is_grey() const { return channels.size() == 1 || find("Y") >= 0; }
  bool is_called(const std::string& name) const {
    return name == prefix || name == part_name || (!prefix.empty() && name == part_name + "." + prefix);
  }
  std::string title() const {
    std::string name = prefix.empty() ? part_name : prefix;
    if (name.size() > 40) name = name.substr(0, 40) + "...";
    return fmt::format("{}({})", name.empty() ? "" : in_quotes(name) + " ", fmt::join(names, ", "));
  }
};

std::vector<Layer> layers_of(OIIO::ImageInput& in, int parts) {
  std::vector<Layer> layers;
  for (int part = 0; part < parts && in.seek_subimage(part, 0); ++part) {
    const OIIO::ImageSpec spec = in.spec();
    const size_t first = layers.size();
    const std::string part_name = spec.get_string_attribute("oiio:subimagename");
    for (int c = 0; c < spec.nchannels; ++c) {
      const std::string& name = spec.channelnames[static_cast<size_t>(c)];
      const size_t dot = name.rfind('.');
      const std::string prefix = dot == std::string::npos ? "" : name.substr(0, dot);
      auto layer = std::find_if(layers.begin() + static_cast<std::ptrdiff_t>(first), layers.end(),
                                [&](const Layer& l) { return l.prefix == prefix; });
      if (layer == layers.end()) layer = layers.insert(layers.end(), {part, part_name, prefix, {}, {}});
      layer->channels.push_back(c);
      layer->names.push_back(dot == std::string::npos ? name : name.substr(dot + 1));
    }
  }
  return layers;
}

std::string listed(const std::vector<const Layer*>& layers) {
  constexpr size_t kShown = 20;
  std::vector<std::string> titles;
  for (const Layer* l : layers) titles.push_back(titles.size() < kShown ? l->title() : "...");
  titles.resize(std::min(titles.size(), kShown + 1));
  return fmt::format("{}", fmt::join(titles, ", "));
}

ChannelChoice channels_of(const Layer& layer) {
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

ChannelChoice needs_name(std::string error) {
  ChannelChoice choice;
  choice.error = std::move(error);
  choice.needs_name = true;
  return choice;
}

ChannelChoice choose(const std::vector<Layer>& layers, const std::string& name) {
  std::vector<const Layer*> all, named, rgb, plain_rgb, grey;
  for (const Layer& l : layers) {
    all.push_back(&l);
    if (l.is_called(name)) named.push_back(&l);
    if (l.has_rgb()) (l.prefix.empty() ? plain_rgb : rgb).push_back(&l);
    if (l.is_grey() && l.prefix.empty()) grey.push_back(&l);
  }
  if (!name.empty()) {
    if (named.size() == 1) return channels_of(*named[0]);
    return needs_name(fmt::format("it has {} {}, but {}",
                                  named.empty() ? "no part or layer" : "several parts or layers", in_quotes(name),
                                  listed(all)));
  }
  for (const auto* found : {&plain_rgb, &rgb, &grey}) {
    if (found->size() == 1) return channels_of(*found->front());
    if (found->size() > 1) return needs_name(fmt::format("it has several parts or layers, {}", listed(*found)));
  }
  if (all.size() == 1) return channels_of(*all[0]);
  return needs_name(fmt::format("none of its parts and layers has R, G, B or Y, but it has {}", listed(all)));
}

}  // namespace

ChannelChoice choose_channels(OIIO::ImageInput& in, const std::string& layer) {
  // Other formats have frames, pages and thumbnails, of which the first is the image.
  const bool has_parts = std::string_view(in.format_name()) == "openexr";
  constexpr int kMostParts = 1000;
  const std::vector<Layer> layers = layers_of(in, has_parts ? kMostParts : 1);
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
