// A smooth metal under a smooth clear coat whose medium only absorbs, in closed form: the mean of the walks of
// bsdfs/layered.h. Everything is a mirror, so light that enters goes to and fro at one cosine mu and leaves in one
// direction: with F the coat's reflectance, r the metal's, and q = r exp(-2 thickness / mu) what a way down and up
// leaves, the whole reflects F + (1 - F)^2 q (1 + F q + (F q)^2 + ...), up to the terms that `maxdepth` allows.
#pragma once

#include "bsdfs/bsdf.h"
#include "bsdfs/coat_table.h"
#include "bsdfs/conductor.h"

namespace etd {

// Both sides of the whole are alike.
struct CoatedMirror {
  static constexpr BsdfTraits kTraits{.delta = true, .reciprocal = true, .energy_conserving = true};
  SmoothDielectric coat;
  SmoothConductor metal;
  float thickness;
  int32_t max_depth;  // events between the layers, of which every second one is at the metal, the first included

  Spectrum eval_cos(Vec3, Vec3, TransportMode, HashStream&) const { return Spectrum(); }
  float pdf(Vec3, Vec3, TransportMode, Lobe) const { return 0.0f; }
  std::optional<BsdfSample> sample(Vec3 wo, Vec3, TransportMode, HashStream&, Lobe sides) const {
    if (!(sides & kReflection) || wo.z == 0.0f) return {};
    return BsdfSample{{-wo.x, -wo.y, wo.z}, albedo(wo), 1.0f, kReflection | kDelta, 1.0f};
  }
  Lobe lobes() const { return kReflection | kDelta; }
  float widest_alpha() const { return 0.0f; }
  bool is_isotropic() const { return true; }

  Spectrum albedo(Vec3 wo) const {
    const auto [reflectance, mu] = fresnel_dielectric(std::min(std::abs(wo.z), 1.0f), coat.eta);
    Spectrum sum(reflectance);
    if (!(mu > 0.0f)) return sum;
    const Spectrum q = metal.albedo({0, 0, mu}) * sqr(coat_transmittance(thickness, mu));
    Spectrum term = q * sqr(1.0f - reflectance);
    for (int depth = 0; depth < max_depth && max_value(term) > 1e-9f; depth += 2) {
      sum += term;
      term *= q * reflectance;
    }
    return sum;
  }
};

}  // namespace etd
