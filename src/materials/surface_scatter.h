// A closure placed on a surface whose shading normal ns need not be its geometric normal ng: the only place that knows
// what follows from that. One function f(viewer, light) is what every estimator computes, whether it comes from the
// camera or from a light:
// - ng alone decides sides: two directions on one side of it reflect, on two sides transmit. No light leaks.
// - The viewer's direction enters the closure with the sign of its z taken from ng. No viewer is behind ns, so nothing
//   that is seen is black for that reason.
// - The light's direction enters as it is, and where ns and ng disagree about its side, it carries nothing.
// The viewer is wo of radiance and wi of importance.
#pragma once

#include "bsdfs/bsdf.h"

namespace etd {

class SurfaceScatter {
 public:
  // frame.z is the shading normal; ng is the geometric normal on its side. The closure must outlive it.
  SurfaceScatter(const Bsdf& bsdf, const Frame& frame, Vec3 ng) : bsdf_(bsdf), frame_(frame), ng_(ng) {}
  SurfaceScatter(const Bsdf&&, const Frame&, Vec3) = delete;

  const Bsdf& bsdf() const { return bsdf_; }

  // f |cos(light, ns)|; of importance f |cos(light, ns)| |cos(viewer, ng)| / |cos(light, ng)|, which makes it the
  // adjoint of radiance on the geometric surface (Veach 1997, equation 5.19).
  Spectrum eval_cos(Vec3 wo, Vec3 wi, TransportMode mode, HashStream& rng) const {
    const bool importance = mode == TransportMode::kImportance;
    const Vec3 viewer = local_viewer(importance ? wi : wo), light = frame_.to_local(importance ? wo : wi);
    if (!carries(light, importance ? wo : wi)) return Spectrum();
    const Spectrum f = bsdf_.eval_cos(viewer, light, TransportMode::kRadiance, rng);
    return importance ? f * std::abs(dot(wi, ng_) / dot(wo, ng_)) : f;
  }

  // eval_cos() and pdf() of radiance.
  BsdfValue eval_pdf(Vec3 wo, Vec3 wi, HashStream& rng) const {
    const Vec3 light = frame_.to_local(wi);
    return carries(light, wi) ? bsdf_.eval_pdf(local_viewer(wo), light, rng) : BsdfValue();
  }

  // Returns the density per solid angle.
  float pdf(Vec3 wo, Vec3 wi, TransportMode mode, Lobe sides = kBothSides) const {
    if (mode == TransportMode::kRadiance) {
      const Vec3 light = frame_.to_local(wi);
      return carries(light, wi) ? bsdf_.pdf(local_viewer(wo), light, mode, sides) : 0.0f;
    }
    const Vec3 light = frame_.to_local(wo);
    if (!carries(light, wo)) return 0.0f;
    return bsdf_.pdf(light, local_viewer(wi), mode, sides) / (has_twin(wi) ? 2.0f : 1.0f);
  }

  std::optional<BsdfSample> sample(Vec3 wo, Vec3 u, TransportMode mode, HashStream& rng,
                                   Lobe sides = kBothSides) const {
    return mode == TransportMode::kRadiance ? sample_light(wo, u, rng, sides) : sample_viewer(wo, u, rng, sides);
  }

  // What a viewer sees: reflectance, and the shading normal on the viewer's side.
  Spectrum albedo(Vec3 wo) const { return bsdf_.albedo(local_viewer(wo)); }
  Vec3 visible_normal(Vec3 wo) const { return dot(wo, ng_) < 0.0f ? -frame_.z : frame_.z; }

 private:
  Vec3 local_viewer(Vec3 w) const {
    const Vec3 local = frame_.to_local(w);
    const float side = dot(w, ng_);
    return {local.x, local.y, side == 0.0f ? 0.0f : std::copysign(local.z, side)};
  }
  // Whether light comes from the side that it seems to come from. Edge on there is none, nor a finite importance.
  bool carries(Vec3 local, Vec3 w) const {
    constexpr float kEdgeOn = 1e-20f;
    const float side = dot(w, ng_);
    return std::abs(side) > kEdgeOn && local.z * side > 0.0f;
  }
  // Whether the closure knows another viewer by the same direction: the mirror image of w behind ns, if both are on one
  // side of ng.
  bool has_twin(Vec3 w) const { return dot(twin(w), ng_) * dot(w, ng_) > 0.0f; }
  Vec3 twin(Vec3 w) const { return w - frame_.z * (2.0f * dot(w, frame_.z)); }

  // Fails where the light would carry nothing.
  std::optional<BsdfSample> sample_light(Vec3 wo, Vec3 u, HashStream& rng, Lobe sides) const {
    std::optional<BsdfSample> s = bsdf_.sample(local_viewer(wo), u, TransportMode::kRadiance, rng, sides);
    if (!s) return s;
    const Vec3 light = s->wi;
    s->wi = frame_.to_world(light);
    if (!carries(light, s->wi)) s.reset();
    return s;
  }

  // Takes each of the viewers whom a local direction stands for with equal probability, so that all can be reached;
  // fails where there is none.
  std::optional<BsdfSample> sample_viewer(Vec3 wo, Vec3 u, HashStream& rng, Lobe sides) const {
    const Vec3 light = frame_.to_local(wo);
    if (!carries(light, wo)) return {};
    std::optional<BsdfSample> s = bsdf_.sample(light, u, TransportMode::kImportance, rng, sides);
    if (!s) return {};
    const float side = s->wi.z;
    const Vec3 first = frame_.to_world(s->wi), second = twin(first);
    const bool sees_first = dot(first, ng_) * side > 0.0f, sees_second = dot(second, ng_) * side > 0.0f;
    if (!sees_first && !sees_second) return {};
    const bool both = sees_first && sees_second;
    s->wi = sees_first && !(both && rng.next_float() < 0.5f) ? first : second;
    s->weight *= std::abs(light.z / side * (dot(s->wi, ng_) / dot(wo, ng_))) * (both ? 2.0f : 1.0f);
    if (both) s->pdf *= 0.5f;
    return s;
  }

  const Bsdf& bsdf_;
  Frame frame_;
  Vec3 ng_;
};

}  // namespace etd
