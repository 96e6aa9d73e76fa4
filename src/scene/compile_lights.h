// The part of compile() that makes lights.
#pragma once

#include <map>

#include "params/diagnostics.h"
#include "scene/description.h"
#include "scene/info.h"
#include "scene/scene.h"

namespace etd {

struct AreaEmission;

// Adds the lights of surfaces to the scene, once their meshes and quadrics are in their final place.
class AreaLightCompiler {
 public:
  AreaLightCompiler(std::filesystem::path folder, Scene& scene, SceneInfo& info, Diagnostics& diagnostics)
      : folder_(std::move(folder)), scene_(scene), info_(info), diagnostics_(diagnostics) {}

  // A light for each triangle, or for two that make a rectangle. `invisible`: no ray meets the surface.
  void add_mesh(const ModelUse& use, uint32_t mesh, bool invisible);
  void add_patches(const ModelUse& use, uint32_t patch_mesh, bool invisible);
  void add_quadric(const ModelUse& use, uint32_t quadric, bool invisible);

 private:
  // Leaves out "scale" and "power".
  AreaEmission emission(const ModelUse& use, bool invisible);

  std::filesystem::path folder_;
  Scene& scene_;
  SceneInfo& info_;
  Diagnostics& diagnostics_;
  std::map<const ModelUse*, const Image*> images_;  // read once, however many shapes the light is on
};

// Adds the lights that are no surfaces, behind those that are.
void compile_lights(const SceneDescription& description, Scene& scene, SceneInfo& info, Diagnostics& diagnostics);

}  // namespace etd
