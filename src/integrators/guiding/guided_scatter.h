// A closure whose directions are chosen by what is known of the light as well: one of two densities, by chance (Vorba
// et al. 2014, section 4.2).
#pragma once

#include "integrators/guiding/guide.h"
#include "materials/surface_scatter.h"

namespace etd {

class GuidedScatter {
 public:
  // Least share of directions that the closure chooses. Its inverse multiplies along a path where the guide misses
  // light.
  static constexpr float kLeastShare = 0.3f;
  // Lobes that are all narrower than this alpha choose better than a guide that does not know them.
  static constexpr float kNarrow = 0.25f;

  // Without a cell (nullptr), and for closures that are narrow or let light through, all directions are the closure's.
  // Where next-event estimation finds most of the light, most are.
  explicit GuidedScatter(const SurfaceScatter& scatter, const GuideCell* cell = nullptr) : scatter_(scatter) {
    if (!cell || !is_guided(scatter.bsdf())) return;
    cell_ = cell;
    share_ = 1.0f - (1.0f - kLeastShare) * (cell->indirect / cell->irradiance);
  }
  GuidedScatter(const SurfaceScatter&&, const GuideCell* = nullptr) = delete;

  const Bsdf& bsdf() const { return scatter_.bsdf(); }

  // Takes SurfaceScatter's results for radiance, with the density of both. That of the guide is added by pdf() alone,
  // for a caller who may not need it.
  BsdfValue eval_pdf(Vec3 wo, Vec3 wi, HashStream& rng) const { return scatter_.eval_pdf(wo, wi, rng); }
  float pdf(Vec3 wi, float scatter_pdf) const { return cell_ ? mix(scatter_pdf, cell_->pdf(wi)) : scatter_pdf; }

  std::optional<BsdfSample> sample(Vec3 wo, Vec3 u, HashStream& rng) const {
    if (!cell_) return scatter_.sample(wo, u, TransportMode::kRadiance, rng);
    return u.z < share_ ? sample_scatter(wo, {u.x, u.y, std::min(u.z / share_, kOneMinusEpsilon)}, rng)
                        : sample_guide(wo, {u.x, u.y}, rng);
  }

 private:
  static bool is_guided(const Bsdf& bsdf) {
    return bsdf.has_smooth_lobe() && !(bsdf.lobes() & kTransmission) && bsdf.widest_alpha() >= kNarrow &&
           !bsdf.traits().stochastic;  // whose density is not that of its samples
  }
  float mix(float scatter, float guide) const { return share_ * scatter + (1.0f - share_) * guide; }

  std::optional<BsdfSample> sample_scatter(Vec3 wo, Vec3 u, HashStream& rng) const {
    std::optional<BsdfSample> s = scatter_.sample(wo, u, TransportMode::kRadiance, rng);
    if (!s) return s;
    // No other density finds a delta lobe's direction.
    const float pdf = s->is_delta() ? share_ * s->pdf : mix(s->pdf, cell_->pdf(s->wi));
    s->weight *= s->pdf / pdf;
    s->pdf = pdf;
    return s;
  }

  std::optional<BsdfSample> sample_guide(Vec3 wo, Vec2 u, HashStream& rng) const {
    const GuidedDirection guide = cell_->sample(u);
    const BsdfValue scatter = scatter_.eval_pdf(wo, guide.w, rng);
    if (is_black(scatter.f_cos)) return {};
    const float pdf = mix(scatter.pdf, guide.pdf);
    // The lobes of a sum are not told apart: what is wide counts as diffuse.
    return BsdfSample{guide.w, scatter.f_cos * (1.0f / pdf), pdf, kReflection | kDiffuse};
  }

  const SurfaceScatter& scatter_;
  const GuideCell* cell_ = nullptr;
  float share_ = 1.0f;  // of the closure
};

}  // namespace etd
