// An image over s and t: (0, 0) is its lower left corner. Bilinear between texel centres on the finest level.
#pragma once

#include "textures/mapping.h"
#include "textures/resolve.h"

namespace etd {

struct ImageMapTexture {
  enum class Wrap : uint8_t { kRepeat, kBlack, kClamp, kOctahedralSphere };
  // What is read of a texel. A float texture is the mean of the colours, or alpha where the image has any that is
  // not 1.
  enum class Channels : uint8_t { kColor, kMean, kAlpha };

  int32_t image = -1;
  Mapping2 mapping;
  float scale = 1;
  bool invert = false, nearest = false;
  Channels channels = Channels::kColor;
  Wrap wrap = Wrap::kRepeat;

  static const ModelDecl& decl();
  static ImageMapTexture create(const ParamReader& p, TextureBuilder& b);

  Spectrum eval(const TexCoord& at, const TextureTable& table) const;

 private:
  Spectrum texel(const Image& img, int x, int y) const;
};

}  // namespace etd
