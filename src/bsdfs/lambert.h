// The ideal diffuse reflector, the same on both of its sides (Lambert 1760): f = R / pi.
#pragma once

#include "bsdfs/bsdf.h"
#include "core/warp.h"

namespace etd {

struct Lambert {
  static constexpr BsdfTraits kTraits{.reciprocal = true, .energy_conserving = true};
  Spectrum reflectance;  // in [0, 1]

  Spectrum eval_cos(Vec3 wo, Vec3 wi, TransportMode, HashStream&) const {
    return same_hemisphere(wo, wi) ? reflectance * (kInvPi * std::abs(wi.z)) : Spectrum();
  }
  float pdf(Vec3 wo, Vec3 wi, TransportMode, Lobe sides) const {
    if (!(sides & kReflection) || is_black(reflectance) || !same_hemisphere(wo, wi)) return 0.0f;
    return pdf_hemisphere_cosine(std::abs(wi.z));
  }
  std::optional<BsdfSample> sample(Vec3 wo, Vec3 u, TransportMode, HashStream&, Lobe sides) const {
    if (!(sides & kReflection) || is_black(reflectance) || wo.z == 0.0f) return {};
    Vec3 wi = sample_hemisphere_cosine({u.x, u.y});
    if (wi.z == 0.0f) return {};
    if (wo.z < 0.0f) wi.z = -wi.z;
    return BsdfSample{wi, reflectance, pdf_hemisphere_cosine(std::abs(wi.z)), kReflection | kDiffuse, 1.0f};
  }
  Lobe lobes() const { return is_black(reflectance) ? kNoLobe : kReflection | kDiffuse; }
  float widest_alpha() const { return 1.0f; }
  bool is_isotropic() const { return true; }
  Spectrum albedo(Vec3) const { return reflectance; }
};

}  // namespace etd
