// Checks a description and builds the immutable scene.
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "core/loading.h"
#include "lights/light_data.h"
#include "params/diagnostics.h"
#include "scene/description.h"
#include "shapes/shape.h"
#include "textures/image_store.h"

namespace etd {

class Scene;
struct SceneInfo;

// What compile() reads from files, kept by those who compile one description several times, seen by different cameras:
// then no file is read twice. The description stays where it is.
struct SceneFiles {
  std::map<const ShapeDesc*, ShapeGeometry> shapes;
  MeshFiles meshes;
  std::optional<TextureTable> images;  // of textures; nothing else of the table counts
  LightImages light_images;
};

struct CompileOptions {
  int width = 0, height = 0;  // of the image: the camera's aspect depends on it
  uint32_t spp = 1;           // that are planned: the more, the smaller the footprint over which textures are filtered
  TextureMemory textures = {};
  SceneFiles* files = nullptr;  // if they are kept
  LoadMonitor monitor = {};
};

// What rays read, and beside it what people are told. Both are null where something was wrong.
struct CompiledScene {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const SceneInfo> info;
};

// Reports everything that is wrong with the description. Throws LoadingStopped when the monitor says so.
CompiledScene compile(const SceneDescription& description, const CompileOptions& options, Diagnostics& diagnostics);

}  // namespace etd
