// Polka dots: in some of the cells of the unit grid a disk, at random but always the same.
#pragma once

#include "textures/mapping.h"
#include "textures/noise.h"
#include "textures/resolve.h"

namespace etd {

struct DotsTexture {
  SpectrumSource inside, outside;
  Mapping2 mapping;

  static const ModelDecl& decl() {
    static const ModelDecl d = with_mapping(
        {Family::kTexture,
         "dots",
         "Dots of radius 0.35 in about half of the unit cells of s and t, whose middles are at whole numbers.",
         {{.name = "inside", .type = ParamType::kSpectrumTexture, .default_value = 1.0, .doc = "In the dots."},
          {.name = "outside", .type = ParamType::kSpectrumTexture, .default_value = 0.0, .doc = "Between them."}}});
    return d;
  }
  static DotsTexture create(const ParamReader& p, TextureBuilder& b) {
    return {b.spectrum(p, "inside"), b.spectrum(p, "outside"), Mapping2::create(p, b)};
  }

  Spectrum eval(const TexCoord& at, const TextureTable& table, const ShadingContext& context) const {
    return table.eval(in_dot(mapping(at, table).st) ? inside : outside, at, context);
  }

 private:
  static bool in_dot(Vec2 st) {
    constexpr float kRadius = 0.35f, kMaxShift = 0.5f - kRadius;
    const float s = std::floor(st.x + 0.5f), t = std::floor(st.y + 0.5f);
    const auto random = [&](float a, float b) { return noise({s + a, t + b, 0.5f}); };
    if (!(random(0.5f, 0.5f) > 0.0f)) return false;
    const float ds = st.x - (s + kMaxShift * random(1.5f, 2.8f)), dt = st.y - (t + kMaxShift * random(4.5f, 9.8f));
    return ds * ds + dt * dt < kRadius * kRadius;
  }
};

}  // namespace etd
