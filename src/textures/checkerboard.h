// Squares or cubes of two textures in turn.
#pragma once

#include "textures/mapping.h"
#include "textures/resolve.h"

namespace etd {

struct CheckerboardTexture {
  SpectrumSource tex1, tex2;
  Mapping2 mapping;
  int32_t solid_space = -1;  // of three dimensions; then `mapping` is not used

  static const ModelDecl& decl() {
    static const ModelDecl d = with_mapping(
        {Family::kTexture,
         "checkerboard",
         "Unit squares over s and t, or unit cubes in texture space, of two textures in turn; filtered.",
         {{.name = "dimension",
           .type = ParamType::kInteger,
           .default_value = 2,
           .min = 2,
           .max = 3,
           .doc = "2: squares over s and t; 3: cubes in the space in which the texture is defined."},
          {.name = "tex1",
           .type = ParamType::kSpectrumTexture,
           .default_value = 1.0,
           .doc = "Of the cell with the corner 0 and 1."},
          {.name = "tex2", .type = ParamType::kSpectrumTexture, .default_value = 0.0, .doc = "Of its neighbours."}}});
    return d;
  }
  static CheckerboardTexture create(const ParamReader& p, TextureBuilder& b) {
    CheckerboardTexture t{b.spectrum(p, "tex1"), b.spectrum(p, "tex2"), {}, -1};
    if (p.integer("dimension") == 2) {
      t.mapping = Mapping2::create(p, b);
    } else {
      t.solid_space = b.space(p);
      warn_of_unread_mapping(p, {"mapping", "uscale", "vscale", "udelta", "vdelta", "v1", "v2"},
                             "a checkerboard of three dimensions");
    }
    return t;
  }

  Spectrum eval(const TexCoord& at, const TextureTable& table, const ShadingContext& context) const {
    const float share2 = 0.5f - 0.5f * mean_sign(at, table);
    if (share2 <= 0.0f) return table.eval(tex1, at, context);
    if (share2 >= 1.0f) return table.eval(tex2, at, context);
    return table.eval(tex1, at, context) * (1.0f - share2) + table.eval(tex2, at, context) * share2;
  }

 private:
  // The mean over the footprint of the function that is 1 in cells of tex1 and -1 in those of tex2.
  float mean_sign(const TexCoord& at, const TextureTable& table) const {
    if (solid_space < 0) {
      const MappedPoint2 m = mapping(at, table);
      return wave(m.st.x, m.dx.x, m.dy.x) * wave(m.st.y, m.dx.y, m.dy.y);
    }
    const MappedPoint3 m = Mapping3{solid_space}(at, table);
    return wave(m.p.x, m.dx.x, m.dy.x) * wave(m.p.y, m.dx.y, m.dy.y) * wave(m.p.z, m.dx.z, m.dy.z);
  }

  // The square wave of period 2, 1 in [0, 1), seen through a triangle of radius r, one and a half times the larger of
  // the two changes.
  static float wave(float x, float dx, float dy) {
    const float r = 1.5f * std::max(std::abs(dx), std::abs(dy));
    const float phase = x - 2.0f * std::floor(0.5f * x);  // exact however far out
    const float half = phase < 1.0f ? 1.0f : -1.0f;
    if (r < 0.5f) {
      const float edge = std::round(phase), s = std::abs(phase - edge);
      return s >= r ? half : half * (1.0f - sqr(1.0f - s / r));
    }
    // The wave integrated twice is a row of parabolas, whose second difference is the mean under a triangle.
    const auto twice_integrated = [](double a) {
      const double y = 0.5 * a - std::floor(0.5 * a) - 0.5;
      return 0.5 * a + y * (1.0 - 2.0 * std::abs(y));
    };
    const double a = phase, w = std::min(static_cast<double>(r), 1e6);
    return static_cast<float>((twice_integrated(a + w) - 2.0 * twice_integrated(a) + twice_integrated(a - w)) /
                              (w * w));
  }
};

}  // namespace etd
