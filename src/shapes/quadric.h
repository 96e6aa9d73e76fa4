// Spheres, cylinders and disks under an affine map, whole or cut: of any radius, stretched, one curved surface that is
// met exactly.
#pragma once

#include <optional>

#include "core/affine.h"
#include "core/bounds.h"
#include "core/transform.h"
#include "shapes/surface_point.h"

namespace etd {

// The part of a unit shape that is there, in coordinates of the unit shape:
//   sphere    x^2 + y^2 + z^2 = 1, lo <= z <= hi
//   cylinder  x^2 + y^2 = 1, lo <= z <= hi
//   disk      z = 0, lo <= r <= hi = 1
// and 0 <= phi <= phi_max, the angle around z counted from x. Outward is away from the origin and the axis; a disk's
// front is +z.
struct QuadricPart {
  enum class Kind : uint8_t { kSphere, kCylinder, kDisk };
  Kind kind = Kind::kSphere;
  float lo = -1, hi = 1;
  float phi_max = 2 * kPi;

  bool is_full_sphere() const { return kind == Kind::kSphere && lo == -1 && hi == 1 && is_full_circle(); }
  bool is_full_circle() const { return phi_max == 2 * kPi; }
  float area() const;  // in the unit shape
};

// Quadrics are kept in double, and with hits given from a point near the origin of the space in which rays meet it: on
// a sphere as large as the Earth, whose surface is all that the scene has of it, floats are half a metre apart.
struct Quadric {
  Affine3d to_world;     // from the unit shape to the space in which rays meet it
  Affine3d to_object;    // its inverse
  Vec3d anchor;          // the point of the unit shape that belongs to the point nearest to the origin, about
  bool flip_ng = false;  // ReverseOrientation: normals point inward, that of a disk to -z
  QuadricPart part;

  Quadric() = default;
  Quadric(const Transform& unit_to_world, bool flip, const QuadricPart& which = {});

  struct Intersection {
    float t;
    Vec3 offset;  // from the anchor to the unit-shape point that was hit
  };
  // The nearest intersection with t_min < t < t_max along o + t d, all roots tried; robust for far and tiny shapes. A
  // part is met a little beyond its edges, so that rounding opens no gap to a neighbour with the same edge.
  std::optional<Intersection> intersect(Point3 o, Vec3 d, float t_max, float t_min = 0) const;
  // What `offset` stands for.
  Vec3d unit_point_at(Vec3 offset) const { return on_unit_shape(anchor + to_double(offset)); }

  Point3 point(Vec3d q) const { return to_float(to_world.point({q.x, q.y, q.z})); }
  // Geometric normal at a unit-shape point, outward unless flipped.
  Vec3 normal(Vec3d q) const {
    const Vec3 ng = to_float(normalize(to_object.transposed(unit_normal(q))));
    return flip_ng ? -ng : ng;
  }
  // Normal of the unit shape, outward.
  Vec3d unit_normal(Vec3d q) const {
    if (part.kind == QuadricPart::Kind::kDisk) return {0, 0, 1};
    return part.kind == QuadricPart::Kind::kCylinder ? Vec3d{q.x, q.y, 0} : q;
  }
  // The point of the unit shape that belongs to a point of the surface.
  Vec3d unit_point(Point3 p) const;
  // How far rounding may take the point at q from where it should be along the surface, in unit coordinates.
  double unit_error(Vec3d q) const { return anchor_error_ + error_slope_ * max_component(abs(q - anchor)); }
  // A box around the surface; not tight for cut spheres.
  Bounds3 bounds() const;

 private:
  Vec3d on_unit_shape(Vec3d q) const;

  double anchor_error_ = 0, error_slope_ = 0;
};

// The same box before the map is rounded to float.
Bounds3 quadric_bounds(const QuadricPart& part, const Transform& unit_to_space);

// The point of the surface whose unit-shape point is q. Next to an edge q is first moved in, as barycentrics of
// triangles are, so that an offset origin does not step across a neighbouring wall. uv as pbrt-v4 has them: u = phi /
// phi_max, v from 0 at lo to 1 at hi, by polar angle on a sphere and by z on a cylinder; on a disk v is 0 at the rim
// and 1 inside.
SurfacePoint quadric_point(const Quadric& quadric, Vec3d q);

// How much area of the surface one unit of area of the unit shape covers around q: |det M| |M^-T n|.
float quadric_area_stretch(const Quadric& quadric, Vec3d q);
// Area of the surface, for any affine map; relative error 1e-4 at most.
float quadric_area(const Quadric& quadric);
// The point for a uniform point of the unit shape's part; its density per area of the surface is
// quadric_pdf_area(q), q being the unit-shape point returned in *q. Uniform whenever the map keeps shapes similar.
SurfacePoint sample_quadric(const Quadric& quadric, Vec2 u, Vec3d* q);
float quadric_pdf_area(const Quadric& quadric, Vec3d q);

}  // namespace etd
