// An orthonormal frame with z as its normal: the local coordinates in which closures scatter.
#pragma once

#include "core/vec.h"

namespace etd {

struct Frame {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  // Any frame around the unit vector n, without a branch near the pole (Duff et al. 2017, listing 3).
  static Frame from_z(Vec3 n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z), b = n.x * n.y * a;
    return {{1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
  }

  // The frame around unit n whose x axis is the part of `tangent` perpendicular to n; any frame when that part is too
  // small to have kept its direction (below 1/1000: an error of rounding of 1e-4).
  static Frame from_z_tangent(Vec3 n, Vec3 tangent) {
    const Vec3 t = tangent - n * dot(n, tangent);
    const float l2 = dot(t, t);
    if (!(l2 > 1e-6f * dot(tangent, tangent)) || !std::isfinite(l2)) return from_z(n);
    const Vec3 x = t * (1.0f / std::sqrt(l2));
    return {x, cross(n, x), n};
  }

  Vec3 to_local(Vec3 v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
  Vec3 to_world(Vec3 v) const { return x * v.x + y * v.y + z * v.z; }
};

// Trigonometry of a direction in local coordinates.
ETD_FN float cos_theta(Vec3 w) { return w.z; }
ETD_FN bool same_hemisphere(Vec3 a, Vec3 b) { return a.z * b.z > 0.0f; }

}  // namespace etd
