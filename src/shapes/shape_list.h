// The list of shapes. To add one: its header, and its name in the list.
#pragma once

#include "core/tagged.h"
#include "shapes/mesh_shapes.h"
#include "shapes/quadric_shapes.h"

namespace etd {

using Shapes = TypeList<TriangleMeshShape, PlyMeshShape, OffMeshShape, ObjMeshShape, BilinearMeshShape, SphereShape,
                        CylinderShape, DiskShape>;

}  // namespace etd
