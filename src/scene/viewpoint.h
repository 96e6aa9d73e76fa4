// Tells from where a scene is looked at: near there its geometry has to be precise.
#pragma once

#include "scene/compile.h"
#include "scene/description.h"

namespace etd {

struct Viewpoint {
  Point3d position;  // in the world of the scene file
  double time = 0;   // of the scene's motion
};

// Returns where the ray through the middle of the film starts, in the middle of the time that the shutter is open. What
// is wrong with the camera is not reported here.
Viewpoint viewpoint_of(const SceneDescription& description, const CompileOptions& options);

}  // namespace etd
