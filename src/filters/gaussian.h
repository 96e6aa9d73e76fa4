// The gaussian filter, lowered so that it reaches zero at its radius. The product of two one-dimensional profiles, each
// sampled through a piecewise-linear table; the weight makes up for what the table misses, so the mean is exact.
#pragma once

#include <array>

#include "filters/filter.h"

namespace etd {

struct GaussianFilter {
  static constexpr int kCells = 64;

  // exp(-x^2 / 2 sigma^2) - exp(-r^2 / 2 sigma^2) on [-r, r].
  struct Profile {
    float r = 1, sigma = 1, edge = 0, integral = 1;
    std::array<float, kCells + 1> cdf{};  // of |x|, at the cell borders

    Profile() = default;
    Profile(float radius, float s) : r(radius), sigma(s) {
      const double rd = r, sd = s, e = std::exp(-rd * rd / (2 * sd * sd));
      edge = static_cast<float>(e);
      integral =
          static_cast<float>(sd * std::sqrt(2 * double{kPi}) * std::erf(rd / (sd * std::sqrt(2.0))) - 2 * rd * e);
      double sum = 0.0;
      std::array<double, kCells + 1> c{};
      for (int i = 0; i < kCells; ++i) c[static_cast<size_t>(i) + 1] = sum += (at(i) + at(i + 1)) / 2.0;
      for (size_t i = 0; i < c.size(); ++i) cdf[i] = static_cast<float>(c[i] / sum);
      cdf[kCells] = 1.0f;
    }
    float value(float d) const { return std::max(0.0f, std::exp(-sqr(d) / (2.0f * sqr(sigma))) - edge); }
    float at(int i) const { return value(r * static_cast<float>(i) / kCells); }
    float eval(float d) const { return std::abs(d) <= r ? value(d) / integral : 0.0f; }

    // A distance in [-r, r], as offset.x, with its weight.
    FilterSample sample(float u) const {
      const float v = std::min(std::abs(2.0f * u - 1.0f), kOneMinusEpsilon);
      const auto i = static_cast<size_t>(std::upper_bound(cdf.begin() + 1, cdf.end() - 1, v) - cdf.begin()) - 1;
      // Within the cell the density is linear from a to b: invert its distribution function.
      const float a = at(static_cast<int>(i)), b = at(static_cast<int>(i) + 1), mass = cdf[i + 1] - cdf[i];
      const float t = mass > 0 ? clamp((v - cdf[i]) / mass, 0.0f, 1.0f) : 0.5f;
      const float s = t * (a + b) / (a + safe_sqrt(lerp(t, sqr(a), sqr(b))));
      const float d = r * (static_cast<float>(i) + s) / kCells;
      const float density = mass * kCells / r * 2.0f * lerp(s, a, b) / (a + b);  // of |x|
      if (!(density > 0)) return {{}, 0.0f};
      return {{u < 0.5f ? -d : d, 0}, value(d) * 2.0f / (integral * density)};
    }
  };

  Profile x, y;

  static const ModelDecl& decl() {
    static const ModelDecl d{
        Family::kFilter,
        "gaussian",
        "A gaussian bump, zero at its radius: smooth, slightly blurred.",
        {{.name = "xradius", .default_value = 1.5, .min = 0, .above_min = true, .unit = "pixels", .doc = "Half width."},
         {.name = "yradius",
          .default_value = 1.5,
          .min = 0,
          .above_min = true,
          .unit = "pixels",
          .doc = "Half height."},
         {.name = "sigma",
          .default_value = 0.5,
          .min = 0,
          .above_min = true,
          .unit = "pixels",
          .doc = "Standard deviation of the bump."}}};
    return d;
  }
  static GaussianFilter create(const ParamReader& p) {
    const float sigma = static_cast<float>(p.number("sigma"));
    return {Profile(static_cast<float>(p.number("xradius")), sigma),
            Profile(static_cast<float>(p.number("yradius")), sigma)};
  }

  FilterSample sample(Vec2 u) const {
    const FilterSample a = x.sample(u.x), b = y.sample(u.y);
    return {{a.offset.x, b.offset.x}, a.weight * b.weight};
  }
  float eval(Vec2 o) const { return x.eval(o.x) * y.eval(o.y); }
  Vec2 radius() const { return {x.r, y.r}; }
};

}  // namespace etd
