// A surface under a clear coat: a dielectric interface above an opaque one, with a medium between them (Guo, Hasan and
// Zhao 2018). There is no closed form, so values are random: a walk between the layers whose mean is the value, as the
// pbrt-v4 format defines it. pdf() is an approximation, good enough as a weight of multiple importance sampling, while
// the weight of a sample comes from the walk that made it.
#pragma once

#include "bsdfs/bsdf.h"
#include "bsdfs/fresnel.h"
#include "core/mis.h"
#include "core/warp.h"
#include "phase/henyey_greenstein.h"

namespace etd {

// The medium and the effort. Distances are in mean free paths: the medium's extinction is 1.
struct LayerSettings {
  Spectrum albedo;          // of the medium's scattering; black: it only absorbs
  float thickness = 0.01f;  // > 0
  float g = 0;              // of the scattering
  int32_t max_depth = 10;   // events between the interfaces after which a walk is given up
  int32_t samples = 1;      // walks for one value
};

// `Top` is a dielectric, `Bottom` reflects only. Both sides of the whole are alike.
template <class Top, class Bottom>
struct Layered {
  static constexpr bool kTopDelta = Top::kTraits.delta, kBottomDelta = Bottom::kTraits.delta;
  static constexpr bool kDeltaOnly = kTopDelta && kBottomDelta;
  static constexpr BsdfTraits kTraits{.stochastic = true, .reciprocal = true, .energy_conserving = true};
  Top top;
  Bottom bottom;
  LayerSettings layer;

  Spectrum eval_cos(Vec3 wo, Vec3 wi, TransportMode mode, HashStream& rng) const {
    if (!same_hemisphere(wo, wi) || (kDeltaOnly && is_black(layer.albedo))) return Spectrum();
    if (wo.z < 0.0f) wo.z = -wo.z, wi.z = -wi.z;
    Spectrum sum;
    for (int i = 0; i < layer.samples; ++i) sum += walk_to(wo, wi, mode, rng);
    return sum / static_cast<float>(layer.samples) + top.eval_cos(wo, wi, mode, rng);
  }

  // The coat's reflection, and what one reflection off the bottom makes if the coat refracts without blur; where the
  // bottom is diffuse, a cosine. A share of cosine covers the rest.
  float pdf(Vec3 wo, Vec3 wi, TransportMode mode, Lobe sides) const {
    if (!(sides & kReflection) || !same_hemisphere(wo, wi) || (kDeltaOnly && is_black(layer.albedo))) return 0.0f;
    wo.z = std::abs(wo.z), wi.z = std::abs(wi.z);
    const DielectricBoundary in = fresnel_dielectric(std::min(wo.z, 1.0f), top.eta);
    const DielectricBoundary out = fresnel_dielectric(std::min(wi.z, 1.0f), top.eta);
    float below = pdf_hemisphere_cosine(wi.z);
    if (!(bottom.lobes() & kDiffuse) && in.cos_t > 0.0f && out.cos_t > 0.0f) {
      const float inv = 1.0f / top.eta;
      const Vec3 wo_in{wo.x * inv, wo.y * inv, in.cos_t}, wi_in{wi.x * inv, wi.y * inv, out.cos_t};
      const float compression = wi.z * inv * inv / out.cos_t;  // solid angle inside over outside
      below = 0.2f * below + 0.8f * bottom.pdf(wo_in, wi_in, mode, kReflection) * compression;
    }
    return in.reflectance * top.pdf(wo, wi, mode, kReflection) + (1.0f - in.reflectance) * below;
  }

  std::optional<BsdfSample> sample(Vec3 wo, Vec3 u, TransportMode mode, HashStream& rng, Lobe sides) const {
    if (!(sides & kReflection) || wo.z == 0.0f) return {};
    const bool flipped = wo.z < 0.0f;
    const Vec3 up{wo.x, wo.y, std::abs(wo.z)};
    std::optional<BsdfSample> s = top.sample(up, u, mode, rng, kBothSides);
    if (!s) return {};
    bool delta = s->is_delta();
    if (s->is_transmission()) {
      Spectrum weight = s->weight;
      const auto wi = walk_out(s->wi, weight, delta, mode, rng);
      if (!wi) return {};
      s->wi = *wi;
      s->weight = weight;
    }
    if (!(s->wi.z > 0.0f)) return {};
    if (flipped) s->wi.z = -s->wi.z;
    s->eta = 1.0f;
    s->lobe = kReflection | (delta ? kDelta : smooth_lobe());
    // A mirror image in the coat is found with the share of the light that the coat reflects, unless all is mirror.
    s->pdf = !delta       ? pdf(wo, s->wi, mode, sides)
             : kDeltaOnly ? 1.0f
                          : fresnel_dielectric(std::min(up.z, 1.0f), top.eta).reflectance;
    if (!(s->pdf > 0.0f)) return {};
    return s;
  }

  Lobe lobes() const {
    const bool scatters = !is_black(layer.albedo);
    Lobe all = kReflection;
    if (kTopDelta) all = all | kDelta;
    if (!kDeltaOnly || scatters) all = all | smooth_lobe();
    return all;
  }
  float widest_alpha() const {
    if (!kDeltaOnly && smooth_lobe() == kGlossy) return std::max(top.widest_alpha(), bottom.widest_alpha());
    return (lobes() & (kDiffuse | kGlossy)) != 0 ? 1.0f : 0.0f;
  }
  bool is_isotropic() const { return top.is_isotropic() && bottom.is_isotropic(); }
  // Coat over base without what happens between them: for features.
  Spectrum albedo(Vec3 wo) const {
    const float coat = fresnel_dielectric(std::min(std::abs(wo.z), 1.0f), top.eta).reflectance;
    return Spectrum(coat) + bottom.albedo(wo) * (1.0f - coat);
  }

 private:
  Lobe smooth_lobe() const { return (bottom.lobes() & kDiffuse) || !is_black(layer.albedo) ? kDiffuse : kGlossy; }
  static Vec3 random3(HashStream& rng) {
    const float x = rng.next_float(), y = rng.next_float();
    return {x, y, rng.next_float()};
  }
  static float transmittance(float distance, Vec3 w) { return std::exp(-std::abs(distance / w.z)); }

  // Ends walks that carry little; false when this one has ended.
  static bool survives(int depth, Spectrum& beta, HashStream& rng) {
    const float strength = max_value(beta);
    if (depth <= 3 || strength >= 0.25f) return strength > 0.0f;
    if (rng.next_float() >= strength) return false;
    beta *= 1.0f / strength;
    return true;
  }

  // Moves from height z along w to the next event: true when it is inside of the medium, otherwise z is at an
  // interface.
  bool advance(float& z, Vec3 w, Spectrum& beta, HashStream& rng) const {
    const float goal = w.z > 0.0f ? layer.thickness : 0.0f;
    if (is_black(layer.albedo)) {
      beta *= transmittance(goal - z, w);
      z = goal;
      return false;
    }
    const float next = z - std::log(1.0f - rng.next_float()) * w.z;
    const bool inside = next > 0.0f && next < layer.thickness;
    z = inside ? next : goal;
    return inside;
  }

  // One walk that enters along wo and is connected to wi, which the coat refracts into the layer, at every event (next
  // event estimation with the presampled direction, combined with the walk's own exits). Returns f cos(wi).
  Spectrum walk_to(Vec3 wo, Vec3 wi, TransportMode mode, HashStream& rng) const {
    const TransportMode reverse =
        mode == TransportMode::kRadiance ? TransportMode::kImportance : TransportMode::kRadiance;
    const auto entry = top.sample(wo, random3(rng), mode, rng, kTransmission);
    const auto exit = top.sample(wi, random3(rng), reverse, rng, kTransmission);
    if (!entry || entry->wi.z == 0.0f) return Spectrum();
    // Without a direction to connect to, the walk's own exits still count: their weights allow for it.
    const bool connects = exit && exit->wi.z != 0.0f;
    if (!connects && kTopDelta) return Spectrum();
    const Vec3 to_exit = connects ? -exit->wi : Vec3{0, 0, 1};  // the direction of the walk that leaves along wi
    const Spectrum leave = connects ? exit->weight * (wi.z / to_exit.z) : Spectrum();
    const float p_exit = connects ? exit->pdf : 0.0f;
    const HenyeyGreenstein phase{layer.g};

    Spectrum sum, beta = entry->weight;
    Vec3 w = entry->wi;
    float z = layer.thickness;
    // Light that the direction w, sampled with density p at height z, brings out along wi by itself.
    const auto add_exit = [&](float p) {
      if (kTopDelta || !(w.z > 0.0f)) return;
      const Spectrum f = top.eval_cos(-w, wi, mode, rng);
      if (is_black(f)) return;
      const float weight =
          p > 0.0f ? mis_weight(MisHeuristic::kPower, p, top.pdf(wi, -w, reverse, kTransmission)) : 1.0f;
      sum += beta * f * (transmittance(layer.thickness - z, w) * weight);
    };
    for (int depth = 0; depth < layer.max_depth && survives(depth, beta, rng); ++depth) {
      if (advance(z, w, beta, rng)) {
        const float p = phase.p(-w, to_exit);
        const float weight = kTopDelta ? 1.0f : mis_weight(MisHeuristic::kPower, p_exit, p);
        Spectrum out(p * weight * transmittance(layer.thickness - z, to_exit));
        if (kDeltaOnly) out = with_mirrors(out, phase.p(-w, {to_exit.x, to_exit.y, -to_exit.z}), z, to_exit);
        sum += beta * layer.albedo * leave * out;
        const Vec3 next = phase.sample(-w, {rng.next_float(), rng.next_float()});
        const float p_next = phase.p(-w, next);
        beta *= layer.albedo;
        w = next;
        if (w.z == 0.0f) break;
        add_exit(p_next);
        continue;
      }
      if (z > 0.0f) {  // at the coat: the part that leaves is counted already
        const auto s = top.sample(-w, random3(rng), mode, rng, kReflection);
        if (!s || s->wi.z == 0.0f) break;
        beta *= s->weight;
        w = s->wi;
        continue;
      }
      if (!kBottomDelta) {
        const float weight =
            kTopDelta ? 1.0f : mis_weight(MisHeuristic::kPower, p_exit, bottom.pdf(-w, to_exit, mode, kReflection));
        sum +=
            beta * bottom.eval_cos(-w, to_exit, mode, rng) * leave * (weight * transmittance(layer.thickness, to_exit));
      }
      const auto s = bottom.sample(-w, random3(rng), mode, rng, kReflection);
      if (!s || s->wi.z == 0.0f) break;
      beta *= s->weight;
      w = s->wi;
      add_exit(kBottomDelta ? 0.0f : s->pdf);
    }
    return sum;
  }

  // Between two mirrors light from height z that leaves along to_exit also arrives by the mirrors, starting up or down
  // any number of times: a geometric series. `up` is what starts upwards, p_down the phase function of starting down.
  Spectrum with_mirrors(Spectrum up, float p_down, float z, Vec3 to_exit) const {
    const Spectrum below = bottom.albedo(to_exit);
    const float above = fresnel_dielectric(std::min(to_exit.z, 1.0f), 1.0f / top.eta).reflectance;
    const float both_ways = above * transmittance(2.0f * layer.thickness, to_exit);
    up += below * (p_down * transmittance(z + layer.thickness, to_exit));
    for (int i = 0; i < Spectrum::kLanes; ++i) up.v[i] /= 1.0f - both_ways * below[i];
    return up;
  }

  // Walks on from below the coat along w until it leaves; nothing when it is given up. As many events as in walk_to.
  std::optional<Vec3> walk_out(Vec3 w, Spectrum& beta, bool& delta, TransportMode mode, HashStream& rng) const {
    const HenyeyGreenstein phase{layer.g};
    float z = layer.thickness;
    for (int depth = 0; depth <= layer.max_depth && survives(depth, beta, rng); ++depth) {
      if (w.z == 0.0f) return {};
      if (advance(z, w, beta, rng)) {
        beta *= layer.albedo;
        w = phase.sample(-w, {rng.next_float(), rng.next_float()});
        delta = false;
        continue;
      }
      const bool at_coat = z > 0.0f;
      if (!at_coat && depth == layer.max_depth) return {};
      const auto s = at_coat ? top.sample(-w, random3(rng), mode, rng, kBothSides)
                             : bottom.sample(-w, random3(rng), mode, rng, kReflection);
      if (!s) return {};
      beta *= s->weight;
      delta = delta && s->is_delta();
      w = s->wi;
      if (at_coat && s->is_transmission()) return w;
    }
    return {};
  }
};

}  // namespace etd
