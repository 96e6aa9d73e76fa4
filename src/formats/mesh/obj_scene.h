// What an OBJ file says beside its triangles, in the models of a scene: materials, textures and lights.
#pragma once

#include "io/obj.h"
#include "params/diagnostics.h"
#include "scene/description.h"

namespace etd {

// Adds the materials, textures and area lights that the parts of `obj` use to `scene`, and returns one trianglemesh for
// each part, placed as `like` is; its material and light hold where the file names none. `file` is the OBJ file's name
// relative to the scene's folder.
std::vector<ShapeDesc> add_obj(ObjResult obj, const std::filesystem::path& file, const ShapeDesc& like,
                               SceneDescription& scene, Diagnostics& diagnostics);

// Shape "objmesh" as its parts; the shape itself when it is wrong or wants the current material only, which is for
// compile() to see.
std::vector<ShapeDesc> expand_objmesh(ShapeDesc shape, SceneDescription& scene, Diagnostics& diagnostics);

// A mesh as the parameters of a trianglemesh.
ModelUse trianglemesh_use(const MeshData& mesh, SourceLoc loc);

}  // namespace etd
