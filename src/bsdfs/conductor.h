// Metals: reflection off an absorbing medium of complex index, smooth or as a rough surface of microfacets. Both sides
// of the surface reflect alike. `eta` and `k` are relative to the medium outside; eta = k = 0 is the perfect mirror.
#pragma once

#include "bsdfs/bsdf.h"
#include "bsdfs/fresnel.h"
#include "bsdfs/microfacet.h"

namespace etd {

struct SmoothConductor {
  static constexpr BsdfTraits kTraits{.delta = true, .reciprocal = true, .energy_conserving = true};
  Spectrum eta, k;

  Spectrum eval_cos(Vec3, Vec3, TransportMode, HashStream&) const { return Spectrum(); }
  float pdf(Vec3, Vec3, TransportMode, Lobe) const { return 0.0f; }
  std::optional<BsdfSample> sample(Vec3 wo, Vec3, TransportMode, HashStream&, Lobe sides) const {
    if (!(sides & kReflection) || wo.z == 0.0f) return {};
    return BsdfSample{{-wo.x, -wo.y, wo.z}, albedo(wo), 1.0f, kReflection | kDelta, 1.0f};
  }
  Lobe lobes() const { return kReflection | kDelta; }
  float widest_alpha() const { return 0.0f; }
  bool is_isotropic() const { return true; }
  Spectrum albedo(Vec3 wo) const { return fresnel_conductor(std::min(std::abs(wo.z), 1.0f), eta, k); }
};

// GGX microfacets with height-correlated shadowing (Heitz 2014) and single scattering: light that meets a second facet
// is lost, so rough metals are darker than smooth ones.
struct RoughConductor {
  static constexpr BsdfTraits kTraits{.reciprocal = true, .energy_conserving = true};
  Spectrum eta, k;
  Ggx ggx;

  Spectrum eval_cos(Vec3 wo, Vec3 wi, TransportMode, HashStream&) const {
    if (!same_hemisphere(wo, wi)) return Spectrum();
    wo = upper(wo), wi = upper(wi);
    const Vec3 h = half_vector(wo, wi);
    return fresnel(wo, h) * (ggx.d(h) * ggx.reflection_factor(wo, wi));
  }

  float pdf(Vec3 wo, Vec3 wi, TransportMode, Lobe sides) const {
    if (!(sides & kReflection) || !same_hemisphere(wo, wi)) return 0.0f;
    wo = upper(wo);
    return ggx.pdf_reflection(wo, half_vector(wo, upper(wi)));
  }

  // Fails when the reflection off a visible facet goes below the surface. The density is that of the rounded wi, so
  // that it equals pdf() bit for bit.
  std::optional<BsdfSample> sample(Vec3 wo, Vec3 u, TransportMode mode, HashStream&, Lobe sides) const {
    if (!(sides & kReflection) || wo.z == 0.0f) return {};
    const Vec3 up = upper(wo), h = ggx.sample_visible(up, {u.x, u.y});
    Vec3 wi = h * (2.0f * dot(up, h)) - up;
    if (!(wi.z > 0.0f)) return {};
    const float masking = ggx.reflection_factor(up, wi) / ggx.reflection_pdf_factor(up);  // G2 / G1 <= 1
    const Spectrum weight = fresnel(up, h) * masking;
    if (wo.z < 0.0f) wi.z = -wi.z;
    const float density = pdf(wo, wi, mode, sides);
    if (!(density > 0.0f)) return {};
    return BsdfSample{wi, weight, density, kReflection | kGlossy, 1.0f};
  }

  Lobe lobes() const { return kReflection | kGlossy; }
  float widest_alpha() const { return std::max(ggx.ax, ggx.ay); }
  bool is_isotropic() const { return ggx.ax == ggx.ay; }
  // This is the albedo of the flat surface: exact as alpha goes to 0; above that it leaves out what is lost between
  // facets and that they are tilted. No closed form is known, and as a feature the metal's colour is what matters.
  Spectrum albedo(Vec3 wo) const { return fresnel_conductor(std::min(std::abs(wo.z), 1.0f), eta, k); }

 private:
  static Vec3 upper(Vec3 w) { return {w.x, w.y, std::abs(w.z)}; }
  // Both directions are on one side. Where they are opposite up to rounding, only the surface normal is left.
  static Vec3 half_vector(Vec3 wo, Vec3 wi) {
    const Vec3 sum = wo + wi;
    const float length2 = dot(sum, sum);
    return length2 > 1e-30f ? sum * (1.0f / std::sqrt(length2)) : Vec3{0, 0, 1};
  }
  Spectrum fresnel(Vec3 wo, Vec3 h) const { return fresnel_conductor(clamp(dot(wo, h), 0.0f, 1.0f), eta, k); }
};

}  // namespace etd
