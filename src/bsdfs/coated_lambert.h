// A diffuse surface under a clear coat whose medium only absorbs, in closed form: the mean of the walks of
// bsdfs/layered.h. What the coat reflects is its own lobe. What it lets in reaches the base, whatever its direction
// then, and leaves it as diffuse light, of which the coat returns the share K any number of times:
//   f(wo, wi) = f_coat(wo, wi) + A(wo) A(wi) / eta^2  rho / pi  (1 + rho K + (rho K)^2 + ...),
// A(w) being the share of a beam along w that the base receives (Wolff 1994, for smooth boundaries without absorption;
// the mean over wi is Saunderson's of 1942). The sum ends after as many reflections off the base as `maxdepth` allows.
#pragma once

#include "bsdfs/bsdf.h"
#include "bsdfs/coat_table.h"
#include "core/warp.h"

namespace etd {

struct SmoothCoat {
  SmoothDielectric boundary;
  float thickness;
  CoatMeans means_of;  // those of this coat

  const CoatMeans& means() const { return means_of; }
  CoatShares shares(float cosine) const {
    const auto [reflectance, cos_t] = fresnel_dielectric(cosine, boundary.eta);
    return {reflectance, cos_t > 0.0f ? (1.0f - reflectance) * coat_transmittance(thickness, cos_t) : 0.0f};
  }
};

struct RoughCoat {
  RoughDielectric boundary;
  const CoatTable* table;  // that of this coat

  const CoatMeans& means() const { return table->means(); }
  CoatShares shares(float cosine) const { return table->shares(cosine); }
};

// Both sides of the whole are alike.
template <class Coat>
struct CoatedLambert {
  static constexpr BsdfTraits kTraits{.reciprocal = true, .energy_conserving = true};
  Coat coat;
  Spectrum base;  // of the light that enters, the share that leaves the base over all reflections, over eta^2

  // `max_depth` counts events between the layers, of which every second one is at the base, the first included.
  CoatedLambert(const Coat& c, const Spectrum& reflectance, int32_t max_depth)
      : coat(c),
        base(reflectance * geometric_sum(reflectance * c.means().returned, (max_depth + 1) / 2) *
             (1.0f / sqr(c.boundary.eta))) {}

  Spectrum eval_cos(Vec3 wo, Vec3 wi, TransportMode mode, HashStream& rng) const {
    if (!same_hemisphere(wo, wi)) return Spectrum();
    return value(shares(wo).entering, upper(wo), upper(wi), mode, rng);
  }

  float pdf(Vec3 wo, Vec3 wi, TransportMode mode, Lobe sides) const {
    if (!(sides & kReflection) || !same_hemisphere(wo, wi)) return 0.0f;
    return density(coat_probability(shares(wo)), upper(wo), upper(wi), mode);
  }

  // The coat's lobe or a cosine, in proportion to what they reflect.
  std::optional<BsdfSample> sample(Vec3 wo, Vec3 u, TransportMode mode, HashStream& rng, Lobe sides) const {
    if (!(sides & kReflection) || wo.z == 0.0f) return {};
    const Vec3 up = upper(wo);
    const CoatShares of_wo = shares(up);
    const float p = coat_probability(of_wo);
    BsdfSample s;
    if (u.z < p) {
      const auto reflection = coat.boundary.sample(up, {u.x, u.y, 0.5f}, mode, rng, kReflection);
      if (!reflection) return {};
      s = *reflection;
    } else {
      s.wi = sample_hemisphere_cosine({u.x, u.y});
      if (s.wi.z == 0.0f) return {};
    }
    if (s.is_delta()) {
      s.weight *= 1.0f / p;
      s.pdf = p;
    } else {
      s.lobe = smooth_lobe();
      s.pdf = density(p, up, s.wi, mode);
      if (!(s.pdf > 0.0f)) return {};
      s.weight = value(of_wo.entering, up, s.wi, mode, rng) / s.pdf;
    }
    if (wo.z < 0.0f) s.wi.z = -s.wi.z;
    return s;
  }

  Lobe lobes() const {
    const Lobe of_coat = coat.boundary.lobes();
    Lobe all = kReflection;
    if ((of_coat & kReflection) && (of_coat & kDelta)) all = all | kDelta;
    if ((of_coat & kGlossy) || !is_black(base)) all = all | smooth_lobe();
    return all;
  }
  float widest_alpha() const { return is_black(base) ? coat.boundary.widest_alpha() : 1.0f; }
  bool is_isotropic() const { return coat.boundary.is_isotropic(); }
  Spectrum albedo(Vec3 wo) const {
    const CoatShares of_wo = shares(wo);
    return Spectrum(of_wo.reflected) + base * (of_wo.entering * coat.means().entering);
  }

 private:
  static Vec3 upper(Vec3 w) { return {w.x, w.y, std::abs(w.z)}; }
  CoatShares shares(Vec3 w) const { return coat.shares(std::min(std::abs(w.z), 1.0f)); }
  // All that has a density is one lobe.
  Lobe smooth_lobe() const { return kReflection | (is_black(base) ? kGlossy : kDiffuse); }

  // Both directions are above.
  Spectrum value(float entering, Vec3 wo, Vec3 wi, TransportMode mode, HashStream& rng) const {
    return coat.boundary.eval_cos(wo, wi, mode, rng) +
           base * (entering * shares(wi).entering * pdf_hemisphere_cosine(wi.z));
  }
  float density(float p, Vec3 wo, Vec3 wi, TransportMode mode) const {
    return p * coat.boundary.pdf(wo, wi, mode, kReflection) + (1.0f - p) * pdf_hemisphere_cosine(wi.z);
  }
  float coat_probability(const CoatShares& of_wo) const {
    const float below = mean_value(base) * of_wo.entering * coat.means().entering;
    return below > 0.0f ? of_wo.reflected / (of_wo.reflected + below) : 1.0f;
  }

  // 1 + x + ... + x^(n - 1), n >= 1, by the binary digits of n: the sums of m and of 2 m terms differ by the factor
  // 1 + x^m. Nothing cancels where x is near 1.
  static Spectrum geometric_sum(const Spectrum& x, int32_t n) {
    Spectrum sum(1.0f), power = x;  // of m = 1 terms; x^m
    int digit = 0;
    while ((n >> digit) > 1) ++digit;
    while (digit-- > 0) {
      sum += sum * power;
      power *= power;
      if (!((n >> digit) & 1)) continue;
      sum = Spectrum(1.0f) + sum * x;
      power *= x;
    }
    return sum;
  }
};

}  // namespace etd
