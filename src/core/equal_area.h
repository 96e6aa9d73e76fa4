// A square and the sphere of directions: the octahedron unfolded so that equal areas of the square have equal solid
// angles (Clarberg 2008, "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD").
#pragma once

#include "core/vec.h"

namespace etd {

// The square [0, 1]^2 to the unit sphere and back: +z in the middle, -z in the corners, x along x, y along y.
Vec3 equal_area_direction(Vec2 st);
Vec2 equal_area_square(Vec3 w);
// The point of the square that a point beyond it stands for: an edge is joined to itself, turned about its middle.
Vec2 wrap_equal_area_square(Vec2 st);

}  // namespace etd
