// Says where an object is in the world at one time: the map from its own space to the world and back, and what a point
// of it is there.
#pragma once

#include "core/affine.h"
#include "core/animated_transform.h"
#include "shapes/surface_point.h"

namespace etd {

struct Placement {
  Affine to_world, to_object;
  // Where the object moves, rays meet it under a map that Embree has interpolated in float, around a pivot at most so
  // far (in the world) from the origin of its space.
  bool moves = false;
  float pivot = 0;
};

Placement placement_at(const AnimatedTransform& motion, float time);

// A point of the object's space as a point of the world. Normals go by the inverse transpose, so that a mirroring
// placement leaves ng where flattening it would have put it: a mesh without normals has its winding turned over by the
// mirror and turned back by the convention. p_error grows by placement_error.
SurfacePoint to_world(const SurfacePoint& s, const Placement& placement);

// The place and the normals of a point of the world as they are in the object's space; the rest stays as it is.
SurfacePoint to_object(const SurfacePoint& s, const Placement& placement);

// How far, in object units, a ray origin near the object-space point p may be from where it should be after Embree has
// taken it from world to object space.
float placement_error(const Placement& placement, Point3 p);

}  // namespace etd
