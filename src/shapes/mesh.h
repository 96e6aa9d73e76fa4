// A triangle mesh in the space in which rays meet it: world space (recentred) or an instance's object space.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/vec.h"

namespace etd {

struct Mesh {
  std::vector<Point3> positions;  // of all motion steps, one step after the other
  std::vector<Vec3> normals;      // empty or one unit normal per position (or zero: the face's)
  std::vector<Vec2> uvs;          // empty or one per vertex, the same at all steps
  std::vector<std::array<uint32_t, 3>> triangles;
  // ReverseOrientation xor mirroring transform: turns the geometric normal of a mesh without normals.
  bool flip_ng = false;
  // More than 1: the mesh deforms. Its vertices are given at even steps of time from 0 to 1 and move straight between.
  uint32_t motion_steps = 1;

  size_t vertex_count() const { return positions.size() / motion_steps; }

  size_t bytes() const {
    return positions.size() * sizeof(Point3) + normals.size() * sizeof(Vec3) + uvs.size() * sizeof(Vec2) +
           triangles.size() * sizeof(triangles[0]);
  }
};

}  // namespace etd
