// Compensation of the light that single scattering on microfacets loses (Turquin 2019, "Practical multiple scattering
// compensation for microfacet models"): the lobe is scaled up by what a lossless surface of the same roughness lacks
// in the direction of the viewer. Exact in a uniform surrounding; elsewhere the light that was scattered repeatedly has
// the distribution of the light that was scattered once.
#pragma once

#include <array>

#include "bsdfs/conductor.h"
#include "bsdfs/rough_dielectric.h"

namespace etd {

// E(alpha, cos): the share of the light that leaves a lossless rough surface again after a single scattering, all
// directions together, by the microfacet width and the cosine of the direction it came from. Interpolated from a grid;
// error below 0.005.
class EnergyTable {
 public:
  // Tabulates closures whose only parameter left is alpha, made by `closure_of`. `two_sided`: both sides of the surface
  // differ.
  template <class F>
  EnergyTable(const F& closure_of, bool two_sided);

  // `cosine` is positive outside (z > 0).
  float albedo(float alpha, float cosine) const;

 private:
  static constexpr int kCells = 23;
  using Grid = std::array<float, (kCells + 1) * (kCells + 1)>;
  Grid outside_, inside_;
};

// That of a rough mirror.
const EnergyTable& mirror_energy();
// That of a rough boundary of this relative index. Made at the first call for an index, and kept; may be called by
// several threads.
const EnergyTable& dielectric_energy(float eta);

// What the closures become in the direction from which E is e: metals lose their own reflectance at each further
// scattering (Turquin 2019, equation 16), clear media nothing.
inline Spectrum energy_gain(const RoughConductor& c, float e) {
  return Spectrum(1.0f) + fresnel_conductor(1.0f, c.eta, c.k) * ((1.0f - e) / e);
}
inline Spectrum energy_gain(const RoughDielectric&, float e) { return Spectrum(1.0f / e); }

// A rough closure with that gain. Not reciprocal, because only the viewer's direction decides; and a beam of light may
// leave with a little more or less energy than it brings, although every viewer of a uniform surrounding sees the right
// amount. Anisotropic surfaces take the table at the root mean square of their widths, which leaves errors of
// some percent.
template <class Rough>
struct EnergyCompensated {
  static constexpr BsdfTraits kTraits{};
  Rough rough;
  const EnergyTable* table;

  Spectrum eval_cos(Vec3 wo, Vec3 wi, TransportMode mode, HashStream& rng) const {
    const Spectrum f = rough.eval_cos(wo, wi, mode, rng);
    return is_black(f) ? f : f * gain(mode == TransportMode::kRadiance ? wo : wi);
  }
  float pdf(Vec3 wo, Vec3 wi, TransportMode mode, Lobe sides) const { return rough.pdf(wo, wi, mode, sides); }
  std::optional<BsdfSample> sample(Vec3 wo, Vec3 u, TransportMode mode, HashStream& rng, Lobe sides) const {
    std::optional<BsdfSample> s = rough.sample(wo, u, mode, rng, sides);
    if (s) s->weight *= gain(mode == TransportMode::kRadiance ? wo : s->wi);
    return s;
  }
  Lobe lobes() const { return rough.lobes(); }
  float widest_alpha() const { return rough.widest_alpha(); }
  bool is_isotropic() const { return rough.is_isotropic(); }
  Spectrum albedo(Vec3 wo) const { return rough.albedo(wo); }

 private:
  Spectrum gain(Vec3 viewer) const {
    return energy_gain(rough, table->albedo(std::sqrt(0.5f * (sqr(rough.ggx.ax) + sqr(rough.ggx.ay))), viewer.z));
  }
};

}  // namespace etd
