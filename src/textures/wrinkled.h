// Turbulence: noise with creases.
#pragma once

#include "textures/mapping.h"
#include "textures/noise_params.h"
#include "textures/resolve.h"

namespace etd {

struct WrinkledTexture {
  static constexpr TextureKind kKind = TextureKind::kFloat;

  Mapping3 mapping;
  NoiseSum sum;

  static const ModelDecl& decl() {
    static const ModelDecl d{Family::kTexture, "wrinkled",
                             "Absolute values of octaves of noise in texture space, with creases where they are 0.",
                             noise_params()};
    return d;
  }
  static WrinkledTexture create(const ParamReader& p, TextureBuilder& b) {
    return {Mapping3::create(p, b), noise_sum(p)};
  }

  Spectrum eval(const TexCoord& at, const TextureTable& table, const ShadingContext&) const {
    const MappedPoint3 m = mapping(at, table);
    return Spectrum(turbulence(m.p, m.dx, m.dy, sum));
  }
};

}  // namespace etd
