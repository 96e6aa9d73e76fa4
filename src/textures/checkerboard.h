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
    return table.eval(in_odd_cell(st.x) == in_odd_cell(st.y) ? tex1 : tex2, at);
  }

 private:
  static bool in_odd_cell(float x) {
    const float half = std::floor(x) * 0.5f;  // exact, so halves are odd cells, however far out
    return half != std::floor(half);
  }
};

}  // namespace etd
