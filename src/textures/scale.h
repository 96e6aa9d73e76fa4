// The product of two textures.
#pragma once

#include "textures/resolve.h"

namespace etd {

struct ScaleTexture {
  SpectrumSource tex;
  FloatSource scale;

  static const ModelDecl& decl() {
    static const ModelDecl d{
        Family::kTexture,
        "scale",
        "A texture times a number or a float texture.",
        {{.name = "tex", .type = ParamType::kSpectrumTexture, .default_value = 1.0, .doc = "What is scaled."},
         {.name = "scale", .type = ParamType::kFloatTexture, .default_value = 1.0, .doc = "The factor."}}};
    return d;
  }
  static ScaleTexture create(const ParamReader& p, TextureBuilder& b) {
    return {b.spectrum(p, "tex"), b.number(p, "scale")};
  }

  Spectrum eval(const TexCoord& at, const TextureTable& table, const ShadingContext& context) const {
    return table.eval(tex, at, context) * table.eval(scale, at, context);
  }
};

}  // namespace etd
