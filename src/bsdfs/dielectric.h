// A smooth boundary between clear media (glass, water): mirror reflection and refraction, chosen by Fresnel's formulas.
#pragma once

#include "bsdfs/bsdf.h"
#include "bsdfs/fresnel.h"

namespace etd {

struct SmoothDielectric {
  static constexpr BsdfTraits kTraits{.delta = true, .reciprocal = true, .energy_conserving = true};
  float eta;  // index inside (z < 0) over index outside (z > 0); 1 lets everything pass straight through

  Spectrum eval_cos(Vec3, Vec3, TransportMode, HashStream&) const { return Spectrum(); }
  float pdf(Vec3, Vec3, TransportMode, Lobe) const { return 0.0f; }

  std::optional<BsdfSample> sample(Vec3 wo, Vec3 u, TransportMode mode, HashStream&, Lobe sides) const {
    if (wo.z == 0.0f) return {};
    const float eta_path = wo.z > 0.0f ? eta : 1.0f / eta;
    const auto [reflectance, cos_t] = fresnel_dielectric(std::min(std::abs(wo.z), 1.0f), eta_path);
    const float reflected = sides & kReflection ? reflectance : 0.0f;
    const float transmitted = sides & kTransmission ? 1.0f - reflectance : 0.0f;
    const float allowed = reflected + transmitted;
    if (!(allowed > 0.0f)) return {};

    // Each lobe is taken with its share of what is allowed, so either way the weight is the allowed share.
    const float p_reflect = reflected / allowed;
    if (u.z < p_reflect)
      return BsdfSample{{-wo.x, -wo.y, wo.z}, Spectrum(allowed), p_reflect, kReflection | kDelta, 1.0f};
    const Vec3 wi{-wo.x / eta_path, -wo.y / eta_path, wo.z > 0.0f ? -cos_t : cos_t};
    // Radiance is compressed or spread with the solid angle (Veach 1997, section 5.2): L / n^2 is what stays the same.
    const float scale = mode == TransportMode::kRadiance ? 1.0f / (eta_path * eta_path) : 1.0f;
    return BsdfSample{wi, Spectrum(allowed * scale), transmitted / allowed, kTransmission | kDelta, eta_path};
  }

  Lobe lobes() const { return eta == 1.0f ? kTransmission | kDelta : kBothSides | kDelta; }
  float widest_alpha() const { return 0.0f; }
  bool is_isotropic() const { return true; }
  Spectrum albedo(Vec3) const { return Spectrum(1.0f); }
};

}  // namespace etd
