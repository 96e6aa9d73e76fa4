// How a medium scatters: the one-parameter lobe of Henyey and Greenstein (1941), whose mean cosine is g.
#pragma once

#include "core/frame.h"

namespace etd {

struct HenyeyGreenstein {
  float g = 0;  // in (-1, 1); positive: mostly forwards

  // Density per solid angle of going on along wi for light that came along -wo; both point away from the event.
  float p(Vec3 wo, Vec3 wi) const {
    const float base = std::max(1.0f + g * g + 2.0f * g * dot(wo, wi), 1e-7f);
    return (1.0f - g * g) / (4.0f * kPi * base * std::sqrt(base));
  }

  // A direction with exactly this density (Witt 1977, equation 19).
  Vec3 sample(Vec3 wo, Vec2 u) const {
    float cosine = 2.0f * u.x - 1.0f;
    if (std::abs(g) > 1e-3f) {
      const float ratio = (1.0f - g * g) / (1.0f - g + 2.0f * g * u.x);
      cosine = (1.0f + g * g - ratio * ratio) / (2.0f * g);
    }
    const float z = clamp(-cosine, -1.0f, 1.0f), r = safe_sqrt(1.0f - z * z), phi = 2.0f * kPi * u.y;
    return Frame::from_z(wo).to_world({r * std::cos(phi), r * std::sin(phi), z});
  }
};

}  // namespace etd
