// A point of a surface as shading sees it, computed from barycentrics or the surface's own parametrisation.
#pragma once

#include "core/vec.h"

namespace etd {

struct SurfacePoint {
  Point3 p;           // in the recentred world
  float p_error = 0;  // how far along ng a ray origin must move to be safely off the surface; same units as p
  Vec3 ng, ns;        // unit geometric and shading normal, ng on the side of ns
  Vec2 uv;
  // These are along growing u and v, not normalised; zero where the parametrisation has none (poles, zero area).
  Vec3 dpdu, dpdv;
  Vec2 parameters;  // u and v of a bilinear patch, which its uv need not be
};

// The origin of a ray that leaves `s` towards w: p moved by p_error along ng to w's side, every coordinate then rounded
// one or two steps further in the direction of the move, so that rounding cannot take any of the distance back (the
// idea of Pharr, Jakob and Humphreys 2023, section 6.8.6).
ETD_FN Point3 offset_origin(const SurfacePoint& s, Vec3 w) {
  const Vec3 shift = s.ng * (dot(w, s.ng) >= 0.0f ? s.p_error : -s.p_error);
  const auto moved = [](float p, float by) {
    const float o = p + by, step = std::max(std::abs(o) * 0x1p-23f, std::numeric_limits<float>::min());
    return by == 0.0f ? o : o + std::copysign(step, by);
  };
  return {moved(s.p.x, shift.x), moved(s.p.y, shift.y), moved(s.p.z, shift.z)};
}

}  // namespace etd
