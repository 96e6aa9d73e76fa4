// The part of compile() that turns shapes and instances into the arrays that rays meet.
#pragma once

#include "params/diagnostics.h"
#include "scene/compile.h"
#include "scene/description.h"
#include "scene/info.h"
#include "scene/scene.h"
#include "scene/viewpoint.h"

namespace etd {

// Fills geometry, bindings, surface lights and origin of `scene`, whose materials are there already, and what `info`
// tells about them.
// material_of[i + 1] is the index in scene.materials of description.materials[i], material_of[0] that of the default;
// kNoId stands for an interface. `files`: what was read before; shapes that are read now are added. The origin
// is the point of the world's bounds that is nearest to the viewpoint: what rounding to float moves is then no more of
// anything than of its distance from there.
void compile_geometry(const SceneDescription& description, const Viewpoint& view,
                      const std::vector<uint32_t>& material_of, const TextureBuilder& textures, SceneFiles& files,
                      Scene& scene, SceneInfo& info, Diagnostics& diagnostics, const LoadMonitor& monitor);

}  // namespace etd
