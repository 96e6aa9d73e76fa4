// What a ray met, by indices into the geometry: the point itself is computed from these, never from o + t d.
#pragma once

#include "core/vec.h"

namespace etd {

inline constexpr uint32_t kNoId = 0xffffffffu;
inline constexpr uint32_t kQuadricGeometry = 0xfffffffeu;
inline constexpr uint32_t kFirstPatchGeometry = 0x80000000u;

struct Hit {
  float t = kInfinity;
  float time = 0;              // of the ray: what moves was where it then is
  uint32_t geometry = kNoId;   // index of the mesh, or of the patch mesh from kFirstPatchGeometry, or kQuadricGeometry
  uint32_t primitive = kNoId;  // triangle or patch of the mesh, or index of the quadric
  uint32_t instance = kNoId;   // kNoId: in the world itself
  float u = 0, v = 0;          // barycentrics b1, b2 of a triangle; u and v of a patch
  Vec3 offset;                 // of a quadric: on its unit shape, from its anchor

  bool on_quadric() const { return geometry == kQuadricGeometry; }
  bool on_patch() const { return geometry >= kFirstPatchGeometry && geometry < kQuadricGeometry; }
  uint32_t patch_mesh() const { return geometry - kFirstPatchGeometry; }
};

}  // namespace etd
