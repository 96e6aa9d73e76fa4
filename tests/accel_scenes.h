// Small geometries that the tests of ray queries share.
#pragma once

#include "accel/geometry.h"

namespace etd {

inline Quadric ellipsoid(const Transform& t) { return Quadric(t, false); }

inline GeometryInstance instance_of(uint32_t group, const Transform& t) {
  return {{Affine(t.matrix()), Affine(t.inverse_matrix())}, group};
}

// The cube [-1, 1]^3 under `t`, 12 triangles that share 8 vertices, winding outwards for an unmirrored map.
inline Mesh box_mesh(const Transform& t) {
  Mesh m;
  for (int i = 0; i < 8; ++i)
    m.positions.push_back(to_float(t.point({i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0})));
  m.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return m;
}

inline Transform generic_rotation() { return Transform::rotate(37.3, {0.3, -0.8, 0.52}); }

}  // namespace etd
