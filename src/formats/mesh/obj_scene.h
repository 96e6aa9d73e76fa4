// What an OBJ file says beside its triangles, in the models of a scene: materials, textures and lights.
#pragma once

#include <map>
#include <memory>

#include "io/obj.h"
#include "params/diagnostics.h"
#include "scene/description.h"

namespace etd {

// An OBJ file with its parts as shapes have them.
struct ObjFile {
  ObjResult obj;                                        // whose parts have no meshes any more
  std::vector<std::shared_ptr<const MeshData>> meshes;  // of the parts

  explicit ObjFile(ObjResult result);
};

// The OBJ files that the shapes of a scene name, each read once and reported for the first shape that names it.
class ObjFiles {
 public:
  struct Found {
    const ObjFile& file;
    bool is_new;
  };
  // `name`: the file's, seen from `folder`.
  Found read(const Param& name, const std::filesystem::path& folder, Diagnostics& diagnostics);

 private:
  std::map<std::filesystem::path, ObjFile> files_;  // by place
};

// Adds the materials, textures and area lights that the parts of `obj` use to `scene`, and returns one trianglemesh for
// each part, placed as `like` is; its material and light hold where the file names none. `file` is the OBJ file's name
// relative to the scene's folder; what is lost of its materials is noted if that is `noted`.
std::vector<ShapeDesc> add_obj(const ObjFile& obj, const std::filesystem::path& file, const ShapeDesc& like, bool noted,
                               SceneDescription& scene, Diagnostics& diagnostics);

// Shape "objmesh" as its parts; the shape itself when it is wrong or wants the current material only, which is for
// compile() to see.
std::vector<ShapeDesc> expand_objmesh(ShapeDesc shape, SceneDescription& scene, ObjFiles& files,
                                      Diagnostics& diagnostics);

}  // namespace etd
