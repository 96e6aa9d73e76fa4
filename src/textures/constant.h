// The same value everywhere.
#pragma once

#include "textures/resolve.h"

namespace etd {

struct ConstantTexture {
  Spectrum value;

  static const ModelDecl& decl() {
    static const ModelDecl d{Family::kTexture,
                             "constant",
                             "The same value everywhere.",
                             {{.name = "value",
                               .type = ParamType::kSpectrum,
                               .default_value = 1.0,
                               .doc = "The value; of a float texture, a float."}}};
    return d;
  }
  static ConstantTexture create(const ParamReader& p, TextureBuilder&) { return {spectrum_value(p, "value")}; }

  Spectrum eval(const TexCoord&, const TextureTable&, const ShadingContext&) const { return value; }
};

}  // namespace etd
