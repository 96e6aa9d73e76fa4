// Coordinates in the plane of a film or a lens. In double: the squares of a pixel's sides are small.
#pragma once

#include "core/vec.h"

namespace etd {

// Two vectors that span the plane, at any angle.
struct PlaneBasis {
  Vec3d a, b, normal;  // normal: a x b, so long as their parallelogram has area

  PlaneBasis(Vec3 along, Vec3 across) : a(to_double(along)), b(to_double(across)), normal(cross(a, b)) {}

  double area() const { return length(normal); }
  // The x and y of v = x a + y b + what is across the plane.
  Vec2 coordinates(Vec3d v) const {
    const double scale = 1.0 / dot(normal, normal);
    return {static_cast<float>(dot(cross(v, b), normal) * scale), static_cast<float>(dot(cross(a, v), normal) * scale)};
  }
};

}  // namespace etd
