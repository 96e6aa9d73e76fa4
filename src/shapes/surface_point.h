// A point of a surface as shading sees it, computed from barycentrics or the surface's own parametrisation.
#pragma once

#include "core/vec.h"

namespace etd {

struct SurfacePoint {
  Point3 p;           // in the recentred world
  float p_error = 0;  // how far along the normal a ray origin must move to be safely off the surface; same units as p
  Vec3 ng, ns;        // unit geometric and shading normal, ng on the side of ns
  Vec2 uv;
  Vec3 dpdu;  // along growing u, not normalised; zero when the parametrisation is degenerate
};

// The origin of a ray that leaves `s` towards w: p moved off the surface to w's side of ng, rounded away from it.
ETD_FN Point3 offset_origin(const SurfacePoint& s, Vec3 w) {
  const Vec3 shift = s.ng * (dot(w, s.ng) >= 0.0f ? s.p_error : -s.p_error);
  return s.p + shift;
}

}  // namespace etd
