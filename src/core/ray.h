// A ray: what cameras make and accelerators trace.
#pragma once

#include "core/vec.h"

namespace etd {

// Says which participating medium a ray is in; kNoMedium is empty space.
using MediumId = uint32_t;
inline constexpr MediumId kNoMedium = 0xffffffffu;

struct Ray {
  Point3 o;
  Vec3 d;  // need not be unit length
  float t_max = kInfinity;
  float time = 0;  // from 0 at the start of the scene's motion to 1 at its end
  MediumId medium = kNoMedium;
  float t_min = 0;  // what lies up to and at this distance is not met
};

}  // namespace etd
