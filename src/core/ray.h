// A ray: what cameras make and accelerators trace.
#pragma once

#include "core/vec.h"

namespace etd {

struct Ray {
  Point3 o;
  Vec3 d;  // need not be unit length
  float t_max = kInfinity;
  float time = 0;   // seconds within the shutter
  float t_min = 0;  // what lies up to and at this distance is not met
};

}  // namespace etd
