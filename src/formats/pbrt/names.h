// The names of a scene: materials, textures, objects, media. pbrt lets a material, an object or a medium be used before
// it is defined, so uses are kept and resolved at the end of the scene. Which texture a parameter means depends on its
// model, so that is left to compile().
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "params/diagnostics.h"
#include "scene/description.h"

namespace etd::pbrt {

class Names {
 public:
  // The index of the named material in `scene`; a place for it is made when it is not defined yet.
  int use_material(const std::string& name, const SourceLoc& loc, SceneDescription& scene);
  // Defines it; a second definition is reported and left out.
  void define_material(const std::string& name, ModelUse use, const SourceLoc& loc, SceneDescription& scene,
                       Diagnostics& diagnostics);

  // False, and reported, when a texture of that kind and name exists already.
  bool define_texture(const std::string& name, bool is_float, const SourceLoc& loc, Diagnostics& diagnostics);

  // False, and reported, when the name is taken.
  bool define_object(const std::string& name, int index, const SourceLoc& loc, Diagnostics& diagnostics);
  void use_object(const std::string& name, const SourceLoc& loc, const TransformPair& to_world, int inside_object);

  void define_medium(const std::string& name, const SourceLoc& loc, Diagnostics& diagnostics);
  void use_medium(const std::string& name, const SourceLoc& loc) { medium_uses_.push_back({name, loc}); }

  // Puts the instances into the scene, reports every name that was used and never defined, and gives stand-ins.
  void resolve(SceneDescription& scene, Diagnostics& diagnostics) const;

 private:
  struct Material {
    int index = -1;
    SourceLoc defined;  // file -1: not yet
    SourceLoc used;     // first use
  };
  struct Use {
    std::string name;
    SourceLoc loc;
  };
  struct ObjectUse {
    std::string name;
    SourceLoc loc;
    TransformPair to_world;
    int inside_object;  // -1: in the world
  };
  struct Object {
    int index;
    SourceLoc defined;
  };

  void resolve_materials(Diagnostics& diagnostics) const;
  void resolve_objects(SceneDescription& scene, Diagnostics& diagnostics) const;

  std::map<std::string, Material> materials_;
  std::map<std::string, SourceLoc> textures_[2];  // spectrum, float
  std::map<std::string, Object> objects_;
  std::vector<ObjectUse> object_uses_;
  std::map<std::string, SourceLoc> media_;
  std::vector<Use> medium_uses_;
};

}  // namespace etd::pbrt
