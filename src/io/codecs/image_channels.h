// Which channels of an image file make the picture, of the part and layer that is meant (io/layer_choice.h).
#pragma once

#include <OpenImageIO/imageio.h>

#include <string>
#include <vector>

namespace etd {

constexpr int kMostParts = 1000;  // of an EXR file that are looked at

struct ChannelChoice {
  int part = 0;
  std::vector<int> of_file;       // of that part: one grey, three colours, four with alpha
  bool luminance_chroma = false;  // the three colours are Y, RY and BY
  std::string error;              // nothing can be chosen
  bool needs_name = false;        // but could be by name
  std::string note;               // what is not taken although one might think so
};

// The part or layer with R, G and B, or else that with Y or the only channel; with `layer`, the part or layer of that
// name. An error that lists them where there is not one to choose.
ChannelChoice choose_channels(OIIO::ImageInput& in, const std::string& layer);

// R, G and B of Rec. 709 in place of Y, RY and BY (Florian Kainz 2004, "Luminance/Chroma Images", in OpenEXR's
// ImfRgbaYca.h).
void luminance_chroma_to_rgb(float* texel);

}  // namespace etd
