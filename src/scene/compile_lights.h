// The part of compile() that makes lights.
#pragma once

#include "params/diagnostics.h"
#include "scene/description.h"
#include "scene/info.h"
#include "scene/scene.h"

namespace etd {

struct ShapeSurfaces;

// Adds the lights of surfaces to the scene, once their meshes and quadrics are in their final place.
class AreaLightCompiler {
 public:
  AreaLightCompiler(ImageSource images, Scene& scene, SceneInfo& info, Diagnostics& diagnostics)
      : images_(std::move(images)), scene_(scene), info_(info), diagnostics_(diagnostics) {}

  // A light for each triangle, or for two that make a rectangle. `invisible`: no ray meets the surface.
  void add_mesh(const ModelUse& use, uint32_t mesh, bool invisible);
  void add_patches(const ModelUse& use, uint32_t patch_mesh, bool invisible);
  void add_quadric(const ModelUse& use, uint32_t quadric, bool invisible);

 private:
  // Returns the index of the first light; they follow each other as the surfaces do.
  uint32_t add(const ModelUse& use, const ShapeSurfaces& surfaces, bool invisible);

  ImageSource images_;
  Scene& scene_;
  SceneInfo& info_;
  Diagnostics& diagnostics_;
};

// Adds the lights that are no surfaces, behind those that are.
void compile_lights(const SceneDescription& description, Scene& scene, SceneInfo& info, Diagnostics& diagnostics);

}  // namespace etd
