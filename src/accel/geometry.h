// Everything that rays can meet, in flat arrays. Group 0 is the world; other groups are object spaces that instances
// place in the world (one level: compile() has flattened deeper nesting).
#pragma once

#include <vector>

#include "shapes/mesh.h"
#include "shapes/sphere.h"

namespace etd {

struct GeometryGroup {
  std::vector<uint32_t> meshes;               // indices into Geometry::meshes
  uint32_t sphere_begin = 0, sphere_end = 0;  // range of Geometry::spheres
};

struct GeometryInstance {
  uint32_t group = 0;
  Affine to_world, to_object;
};

struct Geometry {
  std::vector<Mesh> meshes;
  std::vector<Sphere> spheres;
  std::vector<GeometryGroup> groups = {{}};
  std::vector<GeometryInstance> instances;
};

}  // namespace etd
