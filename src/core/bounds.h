// Boxes: of pixels, half open; of space, closed.
#pragma once

#include "core/vec.h"

namespace etd {

struct PixelBounds {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // [x0, x1) x [y0, y1)
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  bool empty() const { return x1 <= x0 || y1 <= y0; }
  friend bool operator==(const PixelBounds&, const PixelBounds&) = default;
};

struct Bounds3 {
  Point3d lo{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
             std::numeric_limits<double>::infinity()};
  Point3d hi{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
             -std::numeric_limits<double>::infinity()};
  bool empty() const { return !(lo.x <= hi.x); }
  void extend(Point3d p) {
    for (int i = 0; i < 3; ++i) lo[i] = std::min(lo[i], p[i]), hi[i] = std::max(hi[i], p[i]);
  }
  Vec3d diagonal() const { return hi - lo; }
  Point3d center() const { return lo + (hi - lo) * 0.5; }
  // The point of the box that is nearest to p; p itself of an empty one.
  Point3d nearest(Point3d p) const {
    if (empty()) return p;
    for (int i = 0; i < 3; ++i) p[i] = std::min(std::max(p[i], lo[i]), hi[i]);
    return p;
  }
};

// A ball with everything that rays can meet inside of it.
struct BoundingSphere {
  Point3 center;
  float radius = 0;
};

}  // namespace etd
