// What shading and lights need of one triangle of a mesh: the point at barycentrics, its area, uniform sampling.
#pragma once

#include "shapes/mesh.h"
#include "shapes/surface_point.h"

namespace etd {

// The surface at barycentrics b1, b2 (weights of the second and third vertex), in the mesh's own space; a mesh that
// deforms is as it is at `time`.
// Barycentrics are first kept at least 2^-20, and further if p_error asks for it, away from the edges, so that an
// offset origin does not step across a neighbouring wall. `margin` (mesh units) is added to p_error for that purpose
// alone: the error that an instance's transform adds (accel/surface.h). ng follows the winding, turned by
// Mesh::flip_ng; on a mesh with normals it lies on the side of the interpolated normal. Without uvs the vertices have
// (0,0), (1,0), (1,1). A triangle of no area has an arbitrary, finite ng.
// Tangents of texture coordinates cost time; without them dpdu and dpdv are along edges.
SurfacePoint triangle_point(const Mesh& mesh, uint32_t triangle, float b1, float b2, float time = 0, float margin = 0,
                            bool tangents = true);
// Fills Mesh::faces of a mesh that does not deform.
void prepare_faces(Mesh& mesh);
// The point alone, and where the barycentrics put it.
Point3 triangle_position(const Mesh& mesh, uint32_t triangle, float b1, float b2, float time = 0);

// The mesh does not deform, here and in what follows.
TriangleFace triangle_face(const Mesh& mesh, uint32_t triangle);
Vec2 triangle_uv(const Mesh& mesh, uint32_t triangle, size_t corner);
float triangle_area(const Mesh& mesh, uint32_t triangle);

// A uniform point: density 1 / triangle_area per area.
SurfacePoint sample_triangle(const Mesh& mesh, uint32_t triangle, Vec2 u);

// How far from the plane with unit normal n a ray origin near p must be for the ray not to meet the triangle again.
// With u = 2^-24, L the longest edge, and every vertex within L of the origin, the errors along the normal are
//   - u |n|.|p|  from rounding p to float,
//   - u L        from Embree's rounding of the vertices relative to the origin,
//   - 4 u k L    from its normal, a cross product of two rounded edges e, f: |dN| <= 4 u |e||f| = 4 u k |N|, where
//                k = |e||f| / |N| for the two shorter edges, which its stable_triangle_normal prefers,
//   - 3 u L      from the dot product of a vertex with that normal.
// As k >= 1, u (|n|.|p| + 8 k L) covers them; k L is the product of the edges over twice the area, and all but the
// first is TriangleFace::error. Beyond k = 64 (an obtuse sliver of height below L/256) the bound would push origins
// across neighbouring geometry; there we accept that a sliver may shadow itself.
inline float point_error(Point3d p, Vec3 n, float face_error) {
  const double at = std::abs(double(n.x) * p.x) + std::abs(double(n.y) * p.y) + std::abs(double(n.z) * p.z);
  return next_up(static_cast<float>(0x1p-24 * at + double(face_error)));
}

// Smallest barycentric that keeps a point 4 * distance from the edges, and 2^-20 at least; at most 1/8 for triangles
// that are no larger than their own error.
inline double nearest_edge(float distance, float edge) {
  const float wanted = edge * distance;
  return std::max(0x1p-20, wanted < 0.125f ? double(wanted) : 0.125);
}

inline Point3d blend(Point3d p0, Point3d p1, Point3d p2, double b0, double b1, double b2) {
  return {b0 * p0.x + b1 * p1.x + b2 * p2.x, b0 * p0.y + b1 * p1.y + b2 * p2.y, b0 * p0.z + b1 * p1.z + b2 * p2.z};
}

}  // namespace etd
