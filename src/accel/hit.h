// What a ray met, by indices into the geometry: the point itself is computed from these, never from o + t d.
#pragma once

#include "core/vec.h"

namespace etd {

inline constexpr uint32_t kNoId = 0xffffffffu;
inline constexpr uint32_t kQuadricGeometry = 0xfffffffeu;

struct Hit {
  float t = kInfinity;
  uint32_t geometry = kNoId;   // index of the mesh, or kQuadricGeometry
  uint32_t primitive = kNoId;  // triangle of the mesh, or index of the quadric
  uint32_t instance = kNoId;   // kNoId: in the world itself
  float u = 0, v = 0;          // barycentrics b1, b2 of a triangle
  Vec3 q;                      // of a quadric: the point of its unit shape
};

}  // namespace etd
