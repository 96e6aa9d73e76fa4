// Checks a description and builds the immutable scene.
#pragma once

#include <memory>

#include "params/diagnostics.h"
#include "scene/description.h"
#include "textures/image_store.h"

namespace etd {

class Scene;

struct CompileOptions {
  int width = 0, height = 0;  // of the image: the camera's aspect depends on it
  uint32_t spp = 1;           // that are planned: the more, the smaller the footprint over which textures are filtered
  TextureMemory textures = {};
};

// Reports everything that is wrong with the description, and returns null if anything is.
std::unique_ptr<Scene> compile(const SceneDescription& description, const CompileOptions& options,
                               Diagnostics& diagnostics);

}  // namespace etd
