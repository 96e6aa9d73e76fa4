// A sheet of clear material so thin that light leaves it where it entered: a window pane or soap film without
// interference. All reflections between its two smooth surfaces are summed.
#pragma once

#include "bsdfs/bsdf.h"
#include "bsdfs/fresnel.h"

namespace etd {

struct ThinDielectric {
  static constexpr BsdfTraits kTraits{.delta = true, .reciprocal = true, .energy_conserving = true};
  float eta;  // index of the sheet over that around it

  Spectrum eval_cos(Vec3, Vec3, TransportMode, HashStream&) const { return Spectrum(); }
  float pdf(Vec3, Vec3, TransportMode, Lobe) const { return 0.0f; }

  std::optional<BsdfSample> sample(Vec3 wo, Vec3 u, TransportMode, HashStream&, Lobe sides) const {
    if (wo.z == 0.0f) return {};
    // R + T^2 R (1 + R^2 + R^4 + ...) with T = 1 - R (Stokes 1860) is 2 R / (1 + R).
    const float once = fresnel_dielectric(std::min(std::abs(wo.z), 1.0f), eta).reflectance;
    const float reflectance = 2.0f * once / (1.0f + once);
    const float reflected = sides & kReflection ? reflectance : 0.0f;
    const float transmitted = sides & kTransmission ? 1.0f - reflectance : 0.0f;
    const float allowed = reflected + transmitted;
    if (!(allowed > 0.0f)) return {};
    const float p_reflect = reflected / allowed;
    if (u.z < p_reflect)
      return BsdfSample{{-wo.x, -wo.y, wo.z}, Spectrum(allowed), p_reflect, kReflection | kDelta, 1.0f};
    return BsdfSample{-wo, Spectrum(allowed), transmitted / allowed, kTransmission | kDelta, 1.0f};
  }

  Lobe lobes() const { return eta == 1.0f ? kTransmission | kDelta : kBothSides | kDelta; }
  float widest_alpha() const { return 0.0f; }
  bool is_isotropic() const { return true; }
  Spectrum albedo(Vec3) const { return Spectrum(1.0f); }
};

}  // namespace etd
