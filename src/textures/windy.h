// Waves on water under wind that is not everywhere the same.
#pragma once

#include "textures/mapping.h"
#include "textures/noise.h"
#include "textures/resolve.h"

namespace etd {

struct WindyTexture {
  static constexpr TextureKind kKind = TextureKind::kFloat;

  Mapping3 mapping;

  static const ModelDecl& decl() {
    static const ModelDecl d{Family::kTexture,
                             "windy",
                             "Six octaves of noise in texture space, times the size of three octaves at a tenth of "
                             "their frequency.",
                             {}};
    return d;
  }
  static WindyTexture create(const ParamReader& p, TextureBuilder& b) { return {Mapping3::create(p, b)}; }

  Spectrum eval(const TexCoord& at, const TextureTable& table, const ShadingContext&) const {
    const MappedPoint3 m = mapping(at, table);
    const float wind = fbm(Point3{} + (m.p - Point3{}) * 0.1f, m.dx * 0.1f, m.dy * 0.1f, {3, 0.5f});
    return Spectrum(std::abs(wind) * fbm(m.p, m.dx, m.dy, {6, 0.5f}));
  }
};

}  // namespace etd
