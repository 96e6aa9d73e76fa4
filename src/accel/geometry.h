// Everything that rays can meet, in flat arrays. Group 0 is the world; other groups are object spaces that instances
// place in the world (one level: compile() has flattened deeper nesting).
#pragma once

#include <vector>

#include "shapes/mesh.h"
#include "shapes/patch.h"
#include "shapes/quadric.h"

namespace etd {

struct GeometryGroup {
  std::vector<uint32_t> meshes;                 // indices into Geometry::meshes
  uint32_t quadric_begin = 0, quadric_end = 0;  // range of Geometry::quadrics
  std::vector<uint32_t> patch_meshes = {};      // indices into Geometry::patch_meshes
};

struct GeometryInstance {
  uint32_t group = 0;
  Affine to_world, to_object;
};

struct Geometry {
  std::vector<Mesh> meshes;
  std::vector<PatchMesh> patch_meshes;
  std::vector<Quadric> quadrics;
  std::vector<GeometryGroup> groups = {{}};
  std::vector<GeometryInstance> instances;
};

}  // namespace etd
