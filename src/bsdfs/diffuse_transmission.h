// A thin translucent sheet (paper, a leaf): diffuse reflection and diffuse transmission, the same from both sides.
#pragma once

#include "bsdfs/bsdf.h"
#include "core/warp.h"

namespace etd {

struct DiffuseTransmission {
  static constexpr BsdfTraits kTraits{.reciprocal = true, .energy_conserving = true};
  Spectrum reflectance, transmittance;  // together at most 1 in each lane

  Spectrum eval_cos(Vec3 wo, Vec3 wi, TransportMode, HashStream&) const {
    if (wo.z == 0.0f || wi.z == 0.0f) return Spectrum();
    return (same_hemisphere(wo, wi) ? reflectance : transmittance) * (kInvPi * std::abs(wi.z));
  }
  float pdf(Vec3 wo, Vec3 wi, TransportMode, Lobe sides) const {
    if (wo.z == 0.0f || wi.z == 0.0f) return 0.0f;
    const auto [reflected, transmitted] = shares(sides);
    const float share = same_hemisphere(wo, wi) ? reflected : transmitted;
    return share > 0.0f ? share / (reflected + transmitted) * pdf_hemisphere_cosine(std::abs(wi.z)) : 0.0f;
  }
  std::optional<BsdfSample> sample(Vec3 wo, Vec3 u, TransportMode mode, HashStream&, Lobe sides) const {
    const auto [reflected, transmitted] = shares(sides);
    if (!(reflected + transmitted > 0.0f) || wo.z == 0.0f) return {};
    const bool reflects = u.z * (reflected + transmitted) < reflected;
    Vec3 wi = sample_hemisphere_cosine({u.x, u.y});
    if (wi.z == 0.0f) return {};
    if (reflects != (wo.z > 0.0f)) wi.z = -wi.z;
    const float share = (reflects ? reflected : transmitted) / (reflected + transmitted);
    return BsdfSample{wi, (reflects ? reflectance : transmittance) / share, pdf(wo, wi, mode, sides),
                      (reflects ? kReflection : kTransmission) | kDiffuse, 1.0f};
  }
  Lobe lobes() const {
    const Lobe sides =
        (is_black(reflectance) ? kNoLobe : kReflection) | (is_black(transmittance) ? kNoLobe : kTransmission);
    return sides == kNoLobe ? kNoLobe : sides | kDiffuse;
  }
  float widest_alpha() const { return 1.0f; }
  bool is_isotropic() const { return true; }
  Spectrum albedo(Vec3) const { return reflectance + transmittance; }

 private:
  std::pair<float, float> shares(Lobe sides) const {
    return {sides & kReflection ? max_value(reflectance) : 0.0f,
            sides & kTransmission ? max_value(transmittance) : 0.0f};
  }
};

}  // namespace etd
