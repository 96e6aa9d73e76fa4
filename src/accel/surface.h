// From a hit to the surface point in the world: dispatches over triangles, patches and quadrics, and through instances.
#pragma once

#include "accel/geometry.h"
#include "accel/ray.h"
#include "shapes/surface_point.h"

namespace etd {

// The surface at a hit, in the (recentred) world.
SurfacePoint surface_point(const Geometry& geometry, const Hit& hit);

// A point of an instance's object space as a point of the world. Normals go by the inverse transpose, so that a
// mirroring instance leaves ng where flattening the instance would have put it: a mesh without normals has its winding
// turned over by the mirror and turned back by the convention. p_error grows by instance_error.
SurfacePoint to_world(const SurfacePoint& s, const GeometryInstance& instance);

// How far, in object units, a ray origin near the object-space point p may be from where it should be after Embree has
// taken it from world to object space.
float instance_error(const GeometryInstance& instance, Point3 p);

}  // namespace etd
