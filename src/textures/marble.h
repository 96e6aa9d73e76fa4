// Layers of stone, bent by noise.
#pragma once

#include "textures/mapping.h"
#include "textures/noise_params.h"
#include "textures/resolve.h"

namespace etd {

struct MarbleTexture {
  static constexpr TextureKind kKind = TextureKind::kSpectrum;

  Mapping3 mapping;
  NoiseSum sum;
  float scale, variation;

  static const ModelDecl& decl() {
    static const ModelDecl d = [] {
      ModelDecl m{Family::kTexture, "marble",
                  "Layers along y in texture space, bent by noise, in the colours of marble.", noise_params()};
      m.params.push_back({.name = "scale", .default_value = 1.0, .doc = "Factor on the coordinates."});
      m.params.push_back({.name = "variation", .default_value = 0.2, .doc = "How much the noise bends the layers."});
      return m;
    }();
    return d;
  }
  static MarbleTexture create(const ParamReader& p, TextureBuilder& b) {
    return {Mapping3::create(p, b), noise_sum(p), static_cast<float>(p.number("scale")),
            static_cast<float>(p.number("variation"))};
  }

  Spectrum eval(const TexCoord& at, const TextureTable& table, const ShadingContext&) const {
    const MappedPoint3 m = mapping(at, table);
    const Point3 p = Point3{} + (m.p - Point3{}) * scale;
    const float phase = p.y + variation * fbm(p, m.dx * scale, m.dy * scale, sum);
    return color(0.5f + 0.5f * (std::isfinite(phase) ? std::sin(phase) : 0.0f));
  }

 private:
  // Bezier curves through overlapping groups of four colours (those of pbrt-v4), for t in [0, 1].
  static Spectrum color(float t) {
    constexpr int kCurves = 6;
    constexpr float kColors[kCurves + 3][3] = {{0.58f, 0.58f, 0.6f}, {0.58f, 0.58f, 0.6f}, {0.58f, 0.58f, 0.6f},
                                               {0.5f, 0.5f, 0.5f},   {0.6f, 0.59f, 0.58f}, {0.58f, 0.58f, 0.6f},
                                               {0.58f, 0.58f, 0.6f}, {0.2f, 0.2f, 0.33f},  {0.58f, 0.58f, 0.6f}};
    const int first = std::min(static_cast<int>(t * kCurves), kCurves - 1);
    const float u = t * kCurves - static_cast<float>(first), v = 1.0f - u;
    const float weights[4] = {v * v * v, 3 * v * v * u, 3 * v * u * u, u * u * u};
    Spectrum sum;
    for (int i = 0; i < 4; ++i) {
      const float* c = kColors[first + i];
      sum += Spectrum::rgb(c[0], c[1], c[2]) * weights[i];
    }
    return sum * 1.5f;
  }
};

}  // namespace etd
