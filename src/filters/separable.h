// Filters that are a product of the same shape along x and y: each axis is sampled in proportion to the shape's
// absolute value through a piecewise-linear table. The weight makes up for what the table misses, and carries the sign
// of negative lobes (Ernst, Stamminger and Greiner 2006, "Filter Importance Sampling"), so the mean is exact.
#pragma once

#include <array>

#include "filters/filter.h"

namespace etd {

// A shape has a radius r and the functions
//   float value(float d) const    of the distance to the middle, up to a factor; 0 from r on
//   float reach() const           up to r: beyond it lies nothing to speak of, and nothing is sampled
template <class Shape>
class FilterAxis {
 public:
  FilterAxis() = default;
  explicit FilterAxis(const Shape& shape);

  float radius() const { return shape_.r; }
  float eval(float d) const { return shape_.value(std::abs(d)) / integral_; }
  // A distance in [-reach, reach], as offset.x, with its weight.
  FilterSample sample(float u) const;

 private:
  static constexpr int kCells = 64;
  float at(float cell) const { return reach_ * cell / kCells; }

  Shape shape_;
  float reach_ = 1, integral_ = 1;
  std::array<float, kCells + 1> density_{}, cdf_{};  // of |x|, at the borders of the cells of [0, reach]
};

template <class Shape>
FilterAxis<Shape>::FilterAxis(const Shape& shape) : shape_(shape), reach_(shape.reach()) {
  constexpr int kSteps = 64;  // of a cell: the midpoint rule is good to 1e-6
  std::array<double, kCells + 1> nodes{}, sums{};
  double total = 0.0;
  for (size_t i = 0; i < kCells; ++i)
    for (int k = 0; k < kSteps; ++k) {
      const double t = (k + 0.5) / kSteps;
      const double v = shape_.value(at(static_cast<float>(static_cast<double>(i) + t)));
      total += v / kSteps;
      // Means around each border, which are positive wherever there is anything to sample nearby.
      nodes[i] += std::abs(v) * (1.0 - t) / kSteps;
      nodes[i + 1] += std::abs(v) * t / kSteps;
    }
  nodes.front() *= 2.0;
  nodes.back() *= 2.0;
  for (size_t i = 0; i < kCells; ++i) sums[i + 1] = sums[i] + (nodes[i] + nodes[i + 1]) / 2.0;
  integral_ = static_cast<float>(2.0 * total * double{reach_} / kCells);
  for (size_t i = 0; i < sums.size(); ++i) {
    density_[i] = static_cast<float>(nodes[i]);
    cdf_[i] = static_cast<float>(sums[i] / sums.back());
  }
}

template <class Shape>
FilterSample FilterAxis<Shape>::sample(float u) const {
  const float v = std::min(std::abs(2.0f * u - 1.0f), kOneMinusEpsilon);
  const auto i = static_cast<size_t>(std::upper_bound(cdf_.begin() + 1, cdf_.end() - 1, v) - cdf_.begin()) - 1;
  // Within the cell the density is linear from a to b: invert its distribution function.
  const float a = density_[i], b = density_[i + 1], mass = cdf_[i + 1] - cdf_[i];
  const float t = clamp((v - cdf_[i]) / mass, 0.0f, 1.0f);
  const float s = t * (a + b) / (a + safe_sqrt(lerp(t, sqr(a), sqr(b))));
  const float d = at(static_cast<float>(i) + s);
  const float density = mass * kCells / reach_ * 2.0f * lerp(s, a, b) / (a + b);  // of |x|
  if (!(density > 0)) return {{}, 0.0f};
  return {{u < 0.5f ? -d : d, 0}, shape_.value(d) * 2.0f / (integral_ * density)};
}

template <class Shape>
struct SeparableFilter {
  FilterAxis<Shape> x, y;

  FilterSample sample(Vec2 u) const {
    const FilterSample a = x.sample(u.x), b = y.sample(u.y);
    return {{a.offset.x, b.offset.x}, a.weight * b.weight};
  }
  float eval(Vec2 o) const { return x.eval(o.x) * y.eval(o.y); }
  Vec2 radius() const { return {x.radius(), y.radius()}; }
};

}  // namespace etd
