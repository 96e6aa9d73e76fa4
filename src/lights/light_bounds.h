// Where a light is and where it sends light, as far as the choice among many lights needs to know: conservatively, so
// that a light that may reach a point is never taken for one that can't (Conty Estevez and Kulla 2018, section 4.1).
#pragma once

#include "core/bounds.h"
#include "core/math.h"

namespace etd {

// Directions within the angle `spread` (radians) of the unit vector `axis`; with `both`, also those around -axis.
struct DirectionCone {
  Vec3 axis{0, 0, 1};
  float spread = kPi;
  bool both = false;

  bool is_everything() const { return spread >= kPi; }
};

struct LightBounds {
  Bounds3 box;         // of all points that emit
  DirectionCone cone;  // of the normals there, or of the directions that get the most
  // Light leaves at this angle from a direction of the cone at most, radians.
  float fall = 0.5f * kPi;
  // Luminance of the radiant intensity (W/sr) along the directions that get the most, about.
  float intensity = 0;
};

// The narrowest cone that holds both, up to rounding.
DirectionCone unite(DirectionCone a, DirectionCone b);
// The bounds of two lights together.
LightBounds unite(const LightBounds& a, const LightBounds& b);

}  // namespace etd
