// Meshes and patches as rays meet them: their vertices in the space of a group, rounded to float.
#pragma once

#include "core/transform.h"
#include "shapes/mesh.h"
#include "shapes/mesh_shapes.h"
#include "shapes/patch.h"

namespace etd {

// `to_space` ends near the viewer, who is at `viewer` there; faces that are too large for their distance from it are
// cut (shapes/cut_triangles.h).
Mesh place_mesh(const MeshData& data, const Transform& to_space, bool reverse_orientation, Point3d viewer);
PatchMesh place_patches(const PatchData& data, const Transform& to_space, bool reverse_orientation, Point3d viewer);

}  // namespace etd
