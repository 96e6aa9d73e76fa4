// A blend of two textures by the surface's direction.
#pragma once

#include "textures/resolve.h"

namespace etd {

struct DirectionMixTexture {
  SpectrumSource tex1, tex2;
  Vec3 direction;  // unit, in the world

  static const ModelDecl& decl() {
    static const ModelDecl d{Family::kTexture,
                             "directionmix",
                             "A blend of two textures: c tex1 + (1 - c) tex2, with c = |cos| of the angle between the "
                             "geometric normal and a direction.",
                             {{.name = "tex1",
                               .type = ParamType::kSpectrumTexture,
                               .default_value = 0.0,
                               .doc = "Where the surface faces the direction or its opposite."},
                              {.name = "tex2",
                               .type = ParamType::kSpectrumTexture,
                               .default_value = 1.0,
                               .doc = "Where the surface runs along the direction."},
                              {.name = "dir",
                               .type = ParamType::kVector3,
                               .default_value = std::vector<double>{0, 1, 0},
                               .doc = "The direction, in the space in which the texture is defined; of any length."}}};
    return d;
  }
  static DirectionMixTexture create(const ParamReader& p, TextureBuilder& b) {
    const std::vector<double> v = p.numbers("dir");
    const Vec3d world = b.to_world().vector({v[0], v[1], v[2]});
    const double l = length(world);
    DirectionMixTexture t{b.spectrum(p, "tex1"), b.spectrum(p, "tex2"), {0, 1, 0}};
    if (l > 0.0 && std::isfinite(l))
      t.direction = to_float(world * (1.0 / l));
    else
      p.diagnostics().error(p.given("dir") ? p.given("dir")->value_loc : p.use().loc,
                            "the direction \"dir\" has no length");
    return t;
  }

  Spectrum eval(const TexCoord& at, const TextureTable& table, const ShadingContext& context) const {
    const float c = std::min(std::abs(dot(at.n, direction)), 1.0f);
    if (c == 0.0f) return table.eval(tex2, at, context);
    if (c == 1.0f) return table.eval(tex1, at, context);
    return table.eval(tex1, at, context) * c + table.eval(tex2, at, context) * (1.0f - c);
  }
};

}  // namespace etd
