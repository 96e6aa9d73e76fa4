// A triangle mesh in the space in which rays meet it: world space (recentred) or an instance's object space.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/vec.h"

namespace etd {

struct Mesh {
  std::vector<Point3> positions;
  std::vector<Vec3> normals;  // empty or one unit normal per vertex (or zero: the face's)
  std::vector<Vec2> uvs;      // empty or one per vertex
  std::vector<std::array<uint32_t, 3>> triangles;
  // ReverseOrientation xor mirroring transform: turns the geometric normal of a mesh without normals.
  bool flip_ng = false;

  size_t bytes() const {
    return positions.size() * sizeof(Point3) + normals.size() * sizeof(Vec3) + uvs.size() * sizeof(Vec2) +
           triangles.size() * sizeof(triangles[0]);
  }
};

}  // namespace etd
