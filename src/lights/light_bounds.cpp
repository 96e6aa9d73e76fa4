#include "lights/light_bounds.h"

namespace etd {

DirectionCone unite(DirectionCone a, DirectionCone b) {
  const bool both = a.both || b.both;
  const float cosine = dot(a.axis, b.axis);
  // A cone that is open on both sides holds what is around either axis.
  if (both && cosine < 0.0f) b.axis = -b.axis;
  const float between = std::acos(clamp(both ? std::abs(cosine) : cosine, -1.0f, 1.0f));
  a.both = b.both = both;
  if (std::min(between + b.spread, kPi) <= a.spread) return a;
  if (std::min(between + a.spread, kPi) <= b.spread) return b;
  DirectionCone all{a.axis, 0.5f * (a.spread + between + b.spread), both};
  const Vec3 across = b.axis - a.axis * dot(a.axis, b.axis);
  const float l = length(across);
  if (all.spread >= kPi || !(l > 0.0f)) return {a.axis, between > 0.0f ? kPi : std::max(a.spread, b.spread), both};
  const float turn = all.spread - a.spread;
  all.axis = normalize(a.axis * std::cos(turn) + across * (std::sin(turn) / l));
  return all;
}

LightBounds unite(const LightBounds& a, const LightBounds& b) {
  LightBounds all{a.box, unite(a.cone, b.cone), std::max(a.fall, b.fall), a.intensity + b.intensity};
  all.box.extend(b.box.lo);
  all.box.extend(b.box.hi);
  return all;
}

}  // namespace etd
