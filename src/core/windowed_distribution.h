// A point of the unit square whose density is constant in each cell of a grid, restricted to a window: sums over any
// window come from a summed-area table (Crow 1984), as Bitterli, Novak and Jarosz use it for portals (2015,
// "Portal-Masked Environment Map Sampling").
#pragma once

#include <span>
#include <vector>

#include "core/vec.h"

namespace etd {

class WindowedDistribution {
 public:
  using Point = Vec2T<double>;
  // lo <= hi, within the unit square.
  struct Window {
    Point lo, hi;
    bool contains(Point p) const { return p.x >= lo.x && p.x <= hi.x && p.y >= lo.y && p.y <= hi.y; }
  };

  WindowedDistribution() = default;
  // width * height densities up to a common factor, row by row, finite and positive.
  WindowedDistribution(int width, int height, std::span<const double> densities);

  // Returns the integral of the densities over the window.
  double integral(const Window& w) const {
    return sum(w.hi.x, w.hi.y) - sum(w.lo.x, w.hi.y) - sum(w.hi.x, w.lo.y) + sum(w.lo.x, w.lo.y);
  }
  // Takes u in [0, 1)^2; the integral must be positive.
  Point sample(Vec2 u, const Window& w) const;
  // Density of sample() at a point of the window, per area of the unit square.
  double pdf(Point p, const Window& w) const;
  size_t bytes() const { return sums_.size() * sizeof(double); }

 private:
  // Returns the integral of the densities over [0, x] x [0, y].
  double sum(double x, double y) const;
  double corner(int x, int y) const {
    return sums_[static_cast<size_t>(y) * static_cast<size_t>(width_ + 1) + static_cast<size_t>(x)];
  }

  int width_ = 0, height_ = 0;
  std::vector<double> sums_;  // at the corners of the cells
};

}  // namespace etd
