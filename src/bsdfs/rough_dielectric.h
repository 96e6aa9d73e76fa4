// A rough boundary between clear media: frosted glass. Microfacets of GGX reflect and refract as Fresnel says (Walter
// et al. 2007), with height-correlated shadowing and single scattering: light that meets a second facet is lost.
#pragma once

#include "bsdfs/bsdf.h"
#include "bsdfs/fresnel.h"
#include "bsdfs/microfacet.h"

namespace etd {

struct RoughDielectric {
  static constexpr BsdfTraits kTraits{.reciprocal = true, .energy_conserving = true};
  float eta;  // index inside (z < 0) over index outside (z > 0); not 1
  Ggx ggx;

  Spectrum eval_cos(Vec3 wo, Vec3 wi, TransportMode mode, HashStream&) const {
    const Facet facet = find_facet(wo, wi);
    if (!facet.valid) return Spectrum();
    const float shadowed = ggx.d(facet.h) * ggx.reflection_factor(upper(wo), upper(wi)) * facet.jacobian;
    if (same_hemisphere(wo, wi)) return Spectrum(facet.reflectance * shadowed);
    return Spectrum(facet.transmittance * shadowed * radiance_scale(eta_path(wo), mode));
  }

  float pdf(Vec3 wo, Vec3 wi, TransportMode, Lobe sides) const {
    const Facet facet = find_facet(wo, wi);
    if (!facet.valid) return 0.0f;
    const auto [reflected, transmitted] = shares(facet.reflectance, facet.transmittance, sides);
    const float share = same_hemisphere(wo, wi) ? reflected : transmitted;
    return share > 0.0f ? share / (reflected + transmitted) * ggx.d(facet.h) * ggx.reflection_pdf_factor(upper(wo)) *
                              facet.jacobian
                        : 0.0f;
  }

  // Fails when the direction off a visible facet ends on the wrong side of the surface. The density is that of the
  // rounded wi, so that it equals pdf() bit for bit.
  std::optional<BsdfSample> sample(Vec3 wo, Vec3 u, TransportMode mode, HashStream&, Lobe sides) const {
    if (wo.z == 0.0f) return {};
    const Vec3 up = upper(wo), h = ggx.sample_visible(up, {u.x, u.y});
    const float cos_o = clamp(dot(up, h), 0.0f, 1.0f), eta_p = eta_path(wo);
    const auto [reflectance, cos_t] = fresnel_dielectric(cos_o, eta_p);
    const auto [reflected, transmitted] = shares(reflectance, 1.0f - reflectance, sides);
    const float allowed = reflected + transmitted;
    if (!(allowed > 0.0f)) return {};

    const bool reflects = u.z * allowed < reflected;
    Vec3 wi = reflects ? h * (2.0f * dot(up, h)) - up : normalize(h * (cos_o / eta_p - cos_t) - up * (1.0f / eta_p));
    if (reflects != (wi.z > 0.0f) || wi.z == 0.0f) return {};
    const float masking = ggx.reflection_factor(up, upper(wi)) / ggx.reflection_pdf_factor(up);  // G2 / G1 <= 1
    if (wo.z < 0.0f) wi.z = -wi.z;
    const float density = pdf(wo, wi, mode, sides);
    if (!(density > 0.0f)) return {};
    if (reflects) return BsdfSample{wi, Spectrum(allowed * masking), density, kReflection | kGlossy, 1.0f};
    return BsdfSample{wi, Spectrum(allowed * masking * radiance_scale(eta_p, mode)), density, kTransmission | kGlossy,
                      eta_p};
  }

  Lobe lobes() const { return kBothSides | kGlossy; }
  float widest_alpha() const { return std::max(ggx.ax, ggx.ay); }
  bool is_isotropic() const { return ggx.ax == ggx.ay; }
  Spectrum albedo(Vec3) const { return Spectrum(1.0f); }

 private:
  // The facet that takes wo to wi, h.z > 0. `jacobian` is that of h to wi times 4 |wo.h|, which is 1 for reflection.
  struct Facet {
    bool valid = false;
    Vec3 h;
    float reflectance = 0, transmittance = 0, jacobian = 0;
  };

  static Vec3 upper(Vec3 w) { return {w.x, w.y, std::abs(w.z)}; }
  float eta_path(Vec3 wo) const { return wo.z > 0.0f ? eta : 1.0f / eta; }
  // Radiance is compressed or spread with the solid angle (Veach 1997, section 5.2).
  static float radiance_scale(float eta_p, TransportMode mode) {
    return mode == TransportMode::kRadiance ? 1.0f / (eta_p * eta_p) : 1.0f;
  }
  static std::pair<float, float> shares(float reflectance, float transmittance, Lobe sides) {
    return {sides & kReflection ? reflectance : 0.0f, sides & kTransmission ? transmittance : 0.0f};
  }

  // Works in double, and symmetrically in the two directions: where wo grazes the facet, floats would lose the cosine.
  Facet find_facet(Vec3 wo, Vec3 wi) const {
    if (wo.z == 0.0f || wi.z == 0.0f) return {};
    const bool reflects = same_hemisphere(wo, wi), outside = wo.z > 0.0f;
    // Walter et al. 2007, equations 13 and 16: the half vector is along n_o wo + n_i wi, n the indices on both sides.
    const double n_o = reflects || outside ? 1.0 : eta, n_i = reflects || !outside ? 1.0 : eta;
    const Vec3d o = to_double(wo), i = to_double(wi), sum = o * n_o + i * n_i;
    const double length2 = dot(sum, sum);
    if (!(length2 > 1e-30)) return {};
    const Vec3d h = sum * (std::copysign(1.0, sum.z) / std::sqrt(length2));
    // wi must be on the side of the facet to which the facet sends it.
    const double sign = outside ? 1.0 : -1.0, cos_o = sign * dot(o, h), cos_i = sign * dot(i, h);
    if (!(cos_o > 0.0) || (reflects ? !(cos_i > 0.0) : !(cos_i < 0.0))) return {};
    if (reflects) {
      const float reflectance = fresnel_dielectric(std::min(static_cast<float>(cos_o), 1.0f), eta_path(wo)).reflectance;
      return {true, to_float(h), reflectance, 1.0f - reflectance, 1.0f};
    }
    // Equation 17, whose denominator (n_o wo.h + n_i wi.h)^2 is length2.
    const double jacobian = -4.0 * cos_o * cos_i * n_i * n_i / length2;
    const double a = n_o * cos_o, b = -n_i * cos_i, c = -n_o * cos_i, d = n_i * cos_o;
    const double transmittance = 2.0 * (a * b / sqr(a + b) + c * d / sqr(c + d));  // Fresnel, both polarisations
    return {true, to_float(h), static_cast<float>(1.0 - std::min(transmittance, 1.0)),
            static_cast<float>(transmittance), static_cast<float>(jacobian)};
  }
};

}  // namespace etd
