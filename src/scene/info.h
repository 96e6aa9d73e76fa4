// What people are told about a scene: what its file calls things, and how many of them there are. Rays read nothing of
// it.
#pragma once

#include <map>
#include <string>

#include "core/bounds.h"
#include "scene/names.h"

namespace etd {

// What `etendue info` tells beside the sizes of the arrays.
struct SceneSummary {
  std::map<std::string, size_t> shapes, materials, textures, lights;  // by model, as the scene names them
  size_t triangles = 0;                                               // in memory
  size_t instanced_triangles = 0;                                     // as rays see them
  Bounds3 bounds;                                                     // of the world, not recentred
};

struct SceneInfo {
  SceneNames names;
  SceneSummary summary;
};

}  // namespace etd
