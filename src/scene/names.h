// What the scene's file calls the things in the flat arrays of the scene, for telling people about them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "params/source.h"

namespace etd {

struct SceneNames {
  struct Item {
    std::string_view model;  // of the registry; empty where there is none of the name
    SourceLoc loc;
  };
  std::vector<Item> shapes;  // by SurfaceBinding::shape
  // What a person would take for one thing: a shape of the world, or all that an instance of the world places.
  struct Object : Item {
    std::string name;  // of what an instance places
  };
  std::vector<Object> objects;  // by SurfaceBinding::object
  std::vector<Item> lights, materials;
  std::vector<std::string> material_names;  // empty: it has none
};

}  // namespace etd
