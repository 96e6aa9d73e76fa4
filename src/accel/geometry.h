// Everything that rays can meet, in flat arrays. Group 0 is the world; other groups are object spaces that instances
// place in the world (one level: compile() has flattened deeper nesting).
#pragma once

#include <deque>
#include <vector>

#include "shapes/mesh.h"
#include "shapes/patch.h"
#include "shapes/placement.h"
#include "shapes/quadric.h"

namespace etd {

struct GeometryGroup {
  std::vector<uint32_t> meshes;                 // indices into Geometry::meshes
  uint32_t quadric_begin = 0, quadric_end = 0;  // range of Geometry::quadrics
  std::vector<uint32_t> patch_meshes = {};      // indices into Geometry::patch_meshes
};

// A group placed in the world; where it moves, as it is at time 0.
struct GeometryInstance : Placement {
  uint32_t group = 0;
  const AnimatedTransform* motion = nullptr;
};

struct Geometry {
  std::vector<Mesh> meshes;
  std::vector<PatchMesh> patch_meshes;
  std::vector<Quadric> quadrics;
  std::vector<GeometryGroup> groups = {{}};
  std::vector<GeometryInstance> instances;
  std::deque<AnimatedTransform> motions;  // that instances refer to

  Placement placement(uint32_t instance, float time) const {
    const GeometryInstance& i = instances[instance];
    if (i.motion) return placement_at(*i.motion, time);
    return i;
  }
};

}  // namespace etd
