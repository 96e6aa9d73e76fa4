// The gaussian filter, lowered so that it reaches zero at its radius. The product of two one-dimensional profiles, each
// sampled through a piecewise-linear table; the weight makes up for what the table misses, so the mean is exact.
#pragma once

#include <array>

#include "filters/filter.h"

namespace etd {

struct GaussianFilter {
  static constexpr int kCells = 64;

  // exp(-x^2 / 2 sigma^2) - exp(-r^2 / 2 sigma^2) on [-r, r], divided by 1 - exp(-r^2 / 2 sigma^2), so that it is 1 in
  // the middle whatever sigma is: for a wide one it becomes the parabola 1 - x^2 / r^2.
  struct Profile {
    float r = 1, sigma = 1, reach = 1, integral = 1;
    std::array<float, kCells + 1> values{}, cdf{};  // of |x|, at the borders of the cells of [0, reach]

    Profile() = default;
    // Beyond 6 sigma lie 2e-9 of the integral: nothing is sampled there, so that a narrow bump keeps its cells.
    Profile(float radius, float s) : r(radius), sigma(s), reach(std::min(radius, 6.0f * s)) {
      std::array<double, kCells + 1> sums{};
      double exact = 0.0;
      for (int i = 0; i < kCells; ++i) {
        const auto cell = static_cast<float>(i);
        const double left = value(at(cell)), middle = value(at(cell + 0.5f)), right = value(at(cell + 1.0f));
        exact += (left + 4.0 * middle + right) / 6.0;  // Simpson's rule
        sums[static_cast<size_t>(i) + 1] = sums[static_cast<size_t>(i)] + (left + right) / 2.0;
      }
      for (size_t i = 0; i < values.size(); ++i) values[i] = value(at(static_cast<float>(i)));
      integral = static_cast<float>(2.0 * exact * double{reach} / kCells);
      for (size_t i = 0; i < sums.size(); ++i) cdf[i] = static_cast<float>(sums[i] / sums.back());
    }
    // e^-a - e^-b as -e^-a expm1(a - b), which keeps its digits where a and b are small.
    float value(float d) const {
      const float a = sqr(d / sigma) / 2, b = sqr(r / sigma) / 2;
      return d < r ? std::exp(-a) * std::expm1(a - b) / std::expm1(-b) : 0.0f;
    }
    float at(float cell) const { return reach * cell / kCells; }
    float eval(float d) const { return value(std::abs(d)) / integral; }

    // A distance in [-reach, reach], as offset.x, with its weight.
    FilterSample sample(float u) const {
      const float v = std::min(std::abs(2.0f * u - 1.0f), kOneMinusEpsilon);
      const auto i = static_cast<size_t>(std::upper_bound(cdf.begin() + 1, cdf.end() - 1, v) - cdf.begin()) - 1;
      // Within the cell the density is linear from a to b: invert its distribution function.
      const float a = values[i], b = values[i + 1], mass = cdf[i + 1] - cdf[i];
      const float t = clamp((v - cdf[i]) / mass, 0.0f, 1.0f);
      const float s = t * (a + b) / (a + safe_sqrt(lerp(t, sqr(a), sqr(b))));
      const float d = at(static_cast<float>(i) + s);
      const float density = mass * kCells / reach * 2.0f * lerp(s, a, b) / (a + b);  // of |x|
      if (!(density > 0)) return {{}, 0.0f};
      return {{u < 0.5f ? -d : d, 0}, value(d) * 2.0f / (integral * density)};
    }
  };

  Profile x, y;

  static const ModelDecl& decl() {
    static const ModelDecl d{Family::kFilter,
                             "gaussian",
                             "A gaussian bump, zero at its radius: smooth, slightly blurred.",
                             {{.name = "xradius",
                               .default_value = 1.5,
                               .min = kMinFilterSize,
                               .max = kMaxFilterSize,
                               .unit = "pixels",
                               .doc = "Half width."},
                              {.name = "yradius",
                               .default_value = 1.5,
                               .min = kMinFilterSize,
                               .max = kMaxFilterSize,
                               .unit = "pixels",
                               .doc = "Half height."},
                              {.name = "sigma",
                               .default_value = 0.5,
                               .min = kMinFilterSize,
                               .max = kMaxFilterSize,
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
