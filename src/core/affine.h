// Affine maps for what is transformed per ray: of floats, and of doubles where shapes are much larger than what is seen
// of them.
#pragma once

#include "core/transform.h"

namespace etd {

template <class T>
struct AffineT {
  // Columns of the linear part and the translation: p' = x p.x + y p.y + z p.z + t.
  Vec3T<T> x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  Vec3T<T> t;

  AffineT() = default;
  explicit AffineT(const Mat4& m) {
    const auto column = [&m](size_t i) {
      return Vec3T<T>{static_cast<T>(m.m[0][i]), static_cast<T>(m.m[1][i]), static_cast<T>(m.m[2][i])};
    };
    x = column(0), y = column(1), z = column(2), t = column(3);
  }
  Vec3T<T> vector(Vec3T<T> v) const { return x * v.x + y * v.y + z * v.z; }
  Point3T<T> point(Point3T<T> p) const { return Point3T<T>{t.x, t.y, t.z} + vector({p.x, p.y, p.z}); }
  // The transpose applied to v; with the inverse map this transforms normals.
  Vec3T<T> transposed(Vec3T<T> v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }
};
using Affine = AffineT<float>;
using Affine3d = AffineT<double>;

inline double determinant(const Affine3d& a) { return dot(a.x, cross(a.y, a.z)); }
inline double determinant(const Affine& a) { return dot(to_double(a.x), cross(to_double(a.y), to_double(a.z))); }

// How much area one unit of area with the unit normal n covers under the map: |det M| |M^-T n|.
template <class T>
float area_stretch(const AffineT<T>& map, const AffineT<T>& inverse, Vec3T<T> n) {
  return static_cast<float>(static_cast<T>(std::abs(determinant(map))) * length(inverse.transposed(n)));
}

}  // namespace etd
