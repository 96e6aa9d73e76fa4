// Tells where in a scene most of what the camera sees is.
#pragma once

#include "scene/scene.h"

namespace etd {

// A ball around most of the points that rays of the camera meet; of radius 0 if they meet none. `width` and `height`
// are those of the film, in pixels.
BoundingSphere seen_by_camera(const Scene& scene, int width, int height);

}  // namespace etd
