// A float affine map and its inverse, for what is transformed per ray.
#pragma once

#include "core/transform.h"

namespace etd {

struct Affine {
  // Columns of the linear part and the translation: p' = x p.x + y p.y + z p.z + t.
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  Vec3 t;

  Affine() = default;
  explicit Affine(const Mat4& m) {
    const auto& a = m.m;
    x = to_float(Vec3d{a[0][0], a[1][0], a[2][0]});
    y = to_float(Vec3d{a[0][1], a[1][1], a[2][1]});
    z = to_float(Vec3d{a[0][2], a[1][2], a[2][2]});
    t = to_float(Vec3d{a[0][3], a[1][3], a[2][3]});
  }
  Vec3 vector(Vec3 v) const { return x * v.x + y * v.y + z * v.z; }
  Point3 point(Point3 p) const { return Point3{t.x, t.y, t.z} + vector({p.x, p.y, p.z}); }
  // The transpose applied to v; with the inverse map this transforms normals.
  Vec3 transposed(Vec3 v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }
};

inline double determinant(const Affine& a) { return dot(to_double(a.x), cross(to_double(a.y), to_double(a.z))); }

// How much area one unit of area with the unit normal n covers under the map: |det M| |M^-T n|.
inline float area_stretch(const Affine& map, const Affine& inverse, Vec3 n) {
  return static_cast<float>(std::abs(determinant(map))) * length(inverse.transposed(n));
}

}  // namespace etd
