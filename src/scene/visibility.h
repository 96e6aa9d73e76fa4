// What a scene can show, and scenes that must come out black, which their author should know before the render.
#pragma once

#include "params/diagnostics.h"
#include "scene/names.h"
#include "scene/scene.h"

namespace etd {

// Warns when all light comes from points or single directions and every surface is perfectly smooth: no ray that leaves
// such a surface meets such a light, so that nothing can be seen.
void warn_if_nothing_shows(const Scene& scene, const SceneNames& names, Diagnostics& diagnostics);

// Whether any surface reflects like a mirror or refracts like clear glass in places.
bool has_mirrors(const Scene& scene);

}  // namespace etd
