// The unit sphere under an affine map: a sphere of any radius, an ellipsoid.
#pragma once

#include <optional>

#include "shapes/affine.h"

namespace etd {

struct Sphere {
  Affine to_world;       // from the unit sphere to the space in which rays meet it (radius included)
  Affine to_object;      // its inverse
  bool flip_ng = false;  // ReverseOrientation: normals point inward

  struct Intersection {
    float t;
    Vec3 n;  // unit-sphere point that was hit
  };
  // The nearest intersection with 0 < t < t_max along o + t d, both roots tried; robust for far and tiny spheres.
  std::optional<Intersection> intersect(Point3 o, Vec3 d, float t_max) const;

  Point3 point(Vec3 n) const { return to_world.point({n.x, n.y, n.z}); }
  // Geometric normal, outward unless flipped.
  Vec3 normal(Vec3 n) const {
    const Vec3 ng = normalize(to_object.transposed(n));
    return flip_ng ? -ng : ng;
  }
};

}  // namespace etd
