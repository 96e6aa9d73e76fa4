// The sphere as a square: an octahedron unfolded (Cigolle et al. 2014).
#pragma once

#include "core/vec.h"

namespace etd {

// Returns the point of [-1, 1]^2 for a direction of any length but 0.
inline Vec2 to_octahedral(Vec3 w) {
  const float sum = std::abs(w.x) + std::abs(w.y) + std::abs(w.z);
  const float a = w.x / sum, b = w.y / sum;
  if (!(w.z < 0.0f)) return {a, b};
  return {std::copysign(1.0f - std::abs(b), a), std::copysign(1.0f - std::abs(a), b)};
}

// Returns the point of the octahedron |x| + |y| + |z| = 1, which is as long as 1 over the sum of the coordinates of its
// direction. Areas of the square become solid angles when they are divided by the third power of its length.
inline Vec3 from_octahedral(Vec2 p) {
  const float z = 1.0f - std::abs(p.x) - std::abs(p.y);
  if (!(z < 0.0f)) return {p.x, p.y, z};
  return {std::copysign(1.0f - std::abs(p.y), p.x), std::copysign(1.0f - std::abs(p.x), p.y), z};
}

}  // namespace etd
