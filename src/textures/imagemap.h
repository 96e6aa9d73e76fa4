// An image over s and t: (0, 0) is its lower left corner.
#pragma once

#include "textures/mapping.h"
#include "textures/resolve.h"

namespace etd {

struct ImageMapTexture {
  int32_t image = -1;
  Mapping2 mapping;
  float scale = 1, max_anisotropy = 8;
  ImageFilter filter = ImageFilter::kBilinear;
  ImageWrap wrap = ImageWrap::kRepeat;
  bool invert = false;
  // A float texture is the image's alpha where that is not 1 everywhere, otherwise the mean of its colours.
  bool is_float = false;

  static const ModelDecl& decl();
  static ImageMapTexture create(const ParamReader& p, TextureBuilder& b);

  Spectrum eval(const TexCoord& at, const TextureTable& table, const ShadingContext&) const;
};

}  // namespace etd
