// Four values at the corners of the unit square, bilinear between and beyond them.
#pragma once

#include "textures/mapping.h"
#include "textures/resolve.h"

namespace etd {

struct BilerpTexture {
  Spectrum v00, v01, v10, v11;
  Mapping2 mapping;

  static const ModelDecl& decl() {
    const auto corner = [](const char* name, double value, const char* doc) {
      return ParamDecl{.name = name, .type = ParamType::kSpectrum, .default_value = value, .doc = doc};
    };
    static const ModelDecl d =
        with_mapping({Family::kTexture,
                      "bilerp",
                      "Four values at the corners of the unit square of s and t, bilinear "
                      "between them and, without end, beyond; of a float texture, floats.",
                      {corner("v00", 0.0, "At s = 0, t = 0."), corner("v01", 1.0, "At s = 0, t = 1."),
                       corner("v10", 0.0, "At s = 1, t = 0."), corner("v11", 1.0, "At s = 1, t = 1.")}});
    return d;
  }
  static BilerpTexture create(const ParamReader& p, TextureBuilder& b) {
    return {spectrum_value(p, "v00"), spectrum_value(p, "v01"), spectrum_value(p, "v10"), spectrum_value(p, "v11"),
            Mapping2::create(p, b)};
  }

  Spectrum eval(const TexCoord& at, const TextureTable& table, const ShadingContext&) const {
    const Vec2 st = mapping(at, table).st;
    // Coordinates are kept where products of them are numbers.
    const float s = clamp(st.x, -1e15f, 1e15f), t = clamp(st.y, -1e15f, 1e15f);
    return (v00 * (1 - s) + v10 * s) * (1 - t) + (v01 * (1 - s) + v11 * s) * t;
  }
};

}  // namespace etd
