// Finds the surface point of a hit in the world: dispatches over triangles, patches and quadrics, and through
// instances.
#pragma once

#include "accel/geometry.h"
#include "accel/ray.h"
#include "shapes/surface_point.h"

namespace etd {

// The surface at a hit, in the (recentred) world, as it is at the time of the hit. `tangents`: whether those of texture
// coordinates matter (shapes/triangle.h).
SurfacePoint surface_point(const Geometry& geometry, const Hit& hit, bool tangents = true);

}  // namespace etd
