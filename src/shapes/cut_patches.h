// Bilinear patches that are too large for their distance from the viewer, as shapes/cut_triangles.h has it for
// triangles: their u and v are floats too.
#pragma once

#include "io/mesh.h"

namespace etd {

// Cuts patches in four until none has an edge longer than kLongestEdge times its distance from the viewer, or has
// become smaller by 2^40. The surface stays the same, with its texture coordinates and interpolated normals. Neighbours
// of what is cut may stay whole: patches are met a little beyond their edges. The first piece of a patch stays in its
// place.
void cut_coarse_patches(MeshData& vertices, std::vector<std::array<uint32_t, 4>>& patches, Point3d viewer);

}  // namespace etd
