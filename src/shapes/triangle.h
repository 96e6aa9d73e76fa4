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
SurfacePoint triangle_point(const Mesh& mesh, uint32_t triangle, float b1, float b2, float time = 0, float margin = 0);
// The point alone, and where the barycentrics put it.
Point3 triangle_position(const Mesh& mesh, uint32_t triangle, float b1, float b2, float time = 0);

// The mesh does not deform, here and in what follows.
float triangle_area(const Mesh& mesh, uint32_t triangle);

// A uniform point: density 1 / triangle_area per area.
SurfacePoint sample_triangle(const Mesh& mesh, uint32_t triangle, Vec2 u);

}  // namespace etd
