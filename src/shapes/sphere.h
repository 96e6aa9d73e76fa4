// The unit sphere under an affine map: a sphere of any radius, an ellipsoid.
#pragma once

#include <optional>

#include "shapes/affine.h"
#include "shapes/surface_point.h"

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

// The point of `sphere` whose unit-sphere point is n. uv as pbrt-v4 has them: u = phi / 2 pi around object z counted
// from x, v = 1 - theta / pi, so v grows from the pole at -z to the one at +z.
SurfacePoint sphere_point(const Sphere& sphere, Vec3 n);

// How much area of the ellipsoid one unit of area of the unit sphere covers around n: |det M| |M^-T n|.
float sphere_area_stretch(const Sphere& sphere, Vec3 n);
// Area of the whole surface, for any affine map.
float sphere_area(const Sphere& sphere);
// The point for a uniform point of the unit sphere; its density per area of the ellipsoid is sphere_pdf_area(n), n
// being the unit-sphere point returned in *n.
SurfacePoint sample_sphere(const Sphere& sphere, Vec2 u, Vec3* n);
inline float sphere_pdf_area(const Sphere& sphere, Vec3 n) {
  return 1.0f / (4.0f * kPi * sphere_area_stretch(sphere, n));
}

}  // namespace etd
