// Squares of two textures in turn.
#pragma once

#include "textures/resolve.h"
#include "textures/uv_mapping.h"

namespace etd {

struct CheckerboardTexture {
  SpectrumSource tex1, tex2;
  UvMapping mapping;

  static const ModelDecl& decl() {
    static const ModelDecl d = with_uv_mapping(
        {Family::kTexture,
         "checkerboard",
         "Unit squares of two textures in turn, over the scaled uv.",
         {{.name = "tex1",
           .type = ParamType::kSpectrumTexture,
           .default_value = 1.0,
           .doc = "Of the square at (0, 0)."},
          {.name = "tex2", .type = ParamType::kSpectrumTexture, .default_value = 0.0, .doc = "Of its neighbours."}}});
    return d;
  }
  static CheckerboardTexture create(const ParamReader& p, TextureBuilder& b) {
    return {b.spectrum(p, "tex1"), b.spectrum(p, "tex2"), UvMapping::create(p)};
  }

  Spectrum eval(const TexCoord& at, const TextureTable& table) const {
    const Vec2 st = mapping(at.uv);
    const auto parity = static_cast<int64_t>(std::floor(st.x)) + static_cast<int64_t>(std::floor(st.y));
    return table.eval(parity % 2 == 0 ? tex1 : tex2, at);
  }
};

}  // namespace etd
