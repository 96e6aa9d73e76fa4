// Fractional Brownian motion: clouds and terrain.
#pragma once

#include "textures/mapping.h"
#include "textures/noise_params.h"
#include "textures/resolve.h"

namespace etd {

struct FbmTexture {
  static constexpr TextureKind kKind = TextureKind::kFloat;

  Mapping3 mapping;
  NoiseSum sum;

  static const ModelDecl& decl() {
    static const ModelDecl d{Family::kTexture, "fbm",
                             "Octaves of noise in texture space: positive and negative values.", noise_params()};
    return d;
  }
  static FbmTexture create(const ParamReader& p, TextureBuilder& b) { return {Mapping3::create(p, b), noise_sum(p)}; }

  Spectrum eval(const TexCoord& at, const TextureTable& table, const ShadingContext&) const {
    const MappedPoint3 m = mapping(at, table);
    return Spectrum(fbm(m.p, m.dx, m.dy, sum));
  }
};

}  // namespace etd
