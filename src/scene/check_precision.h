// Whether what the camera sees is where it should be.
#pragma once

#include "params/diagnostics.h"
#include "scene/names.h"
#include "scene/scene.h"

namespace etd {

// Warns of shapes that rays from the camera meet at places uncertain by more than half a pixel, most of the times they
// do: floats, or the doubles of the scene file, are too coarse there. docs/algorithms.md says when that happens.
void check_precision(const Scene& scene, const SceneNames& names, int width, int height, Diagnostics& diagnostics);

}  // namespace etd
