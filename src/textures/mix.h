// A blend of two textures.
#pragma once

#include "textures/resolve.h"

namespace etd {

struct MixTexture {
  SpectrumSource tex1, tex2;
  FloatSource amount;

  static const ModelDecl& decl() {
    static const ModelDecl d{
        Family::kTexture,
        "mix",
        "A blend of two textures: (1 - amount) tex1 + amount tex2.",
        {{.name = "tex1", .type = ParamType::kSpectrumTexture, .default_value = 0.0, .doc = "What amount 0 is."},
         {.name = "tex2", .type = ParamType::kSpectrumTexture, .default_value = 1.0, .doc = "What amount 1 is."},
         {.name = "amount",
          .type = ParamType::kFloatTexture,
          .default_value = 0.5,
          .doc = "Share of the second texture; not clamped."}}};
    return d;
  }
  static MixTexture create(const ParamReader& p, TextureBuilder& b) {
    return {b.spectrum(p, "tex1"), b.spectrum(p, "tex2"), b.number(p, "amount")};
  }

  Spectrum eval(const TexCoord& at, const TextureTable& table, const ShadingContext& context) const {
    const float a = table.eval(amount, at, context);
    if (a == 0.0f) return table.eval(tex1, at, context);
    if (a == 1.0f) return table.eval(tex2, at, context);
    return table.eval(tex1, at, context) * (1.0f - a) + table.eval(tex2, at, context) * a;
  }
};

}  // namespace etd
