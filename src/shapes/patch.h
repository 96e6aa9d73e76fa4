// Bilinear patches: the surface that two pairs of opposite edges span, met exactly and not cut into triangles.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/bounds.h"
#include "shapes/surface_point.h"

namespace etd {

// Patches over shared vertices, in the space in which rays meet them. The corners of a patch are those at (u, v) =
// (0, 0), (1, 0), (0, 1), (1, 1).
struct PatchMesh {
  std::vector<Point3> positions;
  std::vector<Vec3> normals;  // empty or one unit normal per vertex (or zero: the surface's)
  std::vector<Vec2> uvs;      // empty or one per vertex
  std::vector<std::array<uint32_t, 4>> patches;
  // ReverseOrientation xor mirroring transform: turns the geometric normal of a mesh without normals.
  bool flip_ng = false;

  size_t bytes() const {
    return positions.size() * sizeof(Point3) + normals.size() * sizeof(Vec3) + uvs.size() * sizeof(Vec2) +
           patches.size() * sizeof(patches[0]);
  }
};

struct PatchIntersection {
  float t, u, v;
};

// The nearest intersection with t_min < t < t_max along o + t d, edges included and a little beyond, so that rounding
// opens no gap to a neighbour.
std::optional<PatchIntersection> intersect_patch(const PatchMesh& mesh, uint32_t patch, Point3 o, Vec3 d, float t_max,
                                                 float t_min = 0);

// The surface at (u, v), which are first kept away from the edges as barycentrics of triangles are; `margin` as in
// triangle_point(). ng is along dp/du x dp/dv, turned by flip_ng, or lies on the side of the interpolated vertex
// normal. Without uvs the texture coordinates are u and v. SurfacePoint::parameters are u and v always.
SurfacePoint patch_point(const PatchMesh& mesh, uint32_t patch, float u, float v, float margin = 0);

Bounds3 patch_bounds(const PatchMesh& mesh, uint32_t patch);

// Computes the area by quadrature, with a relative error of 1e-3 for patches that are not folded.
float patch_area(const PatchMesh& mesh, uint32_t patch);

// A point with a density that is nearly uniform per area: bilinear between the corners' shares of area in (u, v).
SurfacePoint sample_patch(const PatchMesh& mesh, uint32_t patch, Vec2 u);
// The density per area with which sample_patch() makes the point at (u, v).
float patch_pdf_area(const PatchMesh& mesh, uint32_t patch, Vec2 at);

}  // namespace etd
