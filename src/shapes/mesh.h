// A triangle mesh in the space in which rays meet it: world space (recentred) or an instance's object space.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/vec.h"

namespace etd {

// What is the same for all points of a triangle at rest (shapes/triangle.h).
struct TriangleFace {
  Vec3 n;           // unit normal, along (p1 - p0) x (p2 - p0)
  float error = 0;  // part of the error bound of points
  float edge = 0;   // barycentrics at a distance from the edges, per length; infinite for a triangle of no area
};

struct Mesh {
  std::vector<Point3> positions;  // of all motion steps, one step after the other
  std::vector<Vec3> normals;      // empty or one unit normal per position (or zero: the face's)
  std::vector<Vec2> uvs;          // empty or one per vertex, the same at all steps
  std::vector<std::array<uint32_t, 3>> triangles;
  std::vector<TriangleFace> faces;  // one per triangle; empty while unknown, and where the mesh deforms
  // ReverseOrientation xor mirroring transform: turns the geometric normal of a mesh without normals.
  bool flip_ng = false;
  // More than 1: the mesh deforms. Its vertices are given at even steps of time from 0 to 1 and move straight between.
  uint32_t motion_steps = 1;

  size_t vertex_count() const { return positions.size() / motion_steps; }

  size_t bytes() const {
    return positions.size() * sizeof(Point3) + normals.size() * sizeof(Vec3) + uvs.size() * sizeof(Vec2) +
           triangles.size() * sizeof(triangles[0]) + faces.size() * sizeof(TriangleFace);
  }
};

}  // namespace etd
