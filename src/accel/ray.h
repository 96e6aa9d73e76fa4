// Rays and hits: the language between integrators and whatever answers ray queries.
#pragma once

#include "core/vec.h"

namespace etd {

struct Ray {
  Point3 o;
  Vec3 d;  // need not be unit length
  float t_max = kInfinity;
  float time = 0;  // seconds within the shutter
};

inline constexpr uint32_t kNoId = 0xffffffffu;

// What was hit, by indices into the geometry; the point itself is computed from these, never from o + t d.
struct Hit {
  float t = kInfinity;
  uint32_t geometry = kNoId;   // index of the mesh, or kSphereGeometry
  uint32_t primitive = kNoId;  // triangle of the mesh, or index of the sphere
  uint32_t instance = kNoId;   // kNoId: in the world itself
  float u = 0, v = 0;          // barycentrics b1, b2 of a triangle
  Vec3 n;                      // of a sphere: the unit object-space direction from its centre to the point
};
inline constexpr uint32_t kSphereGeometry = 0xfffffffeu;

}  // namespace etd
