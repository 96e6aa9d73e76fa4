// A closure placed on a surface: world directions, and the agreement between shading and geometric normal. Reflection
// must keep, and transmission change, the side of both normals; otherwise light would leak through the surface, so
// eval is 0 and sample fails.
#pragma once

#include "bsdfs/bsdf.h"

namespace etd {

class SurfaceScatter {
 public:
  // frame.z is the shading normal; ng is the geometric normal on its side.
  SurfaceScatter(const Bsdf& bsdf, const Frame& frame, Vec3 ng) : bsdf_(bsdf), frame_(frame), ng_(ng) {}

  const Bsdf& bsdf() const { return bsdf_; }

  // f |cos(wi, ns)|; in importance mode times the adjoint factor of shading normals (Veach 1997, eq. 5.19).
  Spectrum eval_cos(Vec3 wo, Vec3 wi, TransportMode mode, HashStream& rng) const {
    const Vec3 o = frame_.to_local(wo), i = frame_.to_local(wi);
    if (!sides_agree(wo, wi, o.z, i.z)) return Spectrum();
    return bsdf_.eval_cos(o, i, mode, rng) * adjoint_factor(wo, wi, o.z, i.z, mode);
  }

  // Per solid angle.
  float pdf(Vec3 wo, Vec3 wi, TransportMode mode, Lobe sides = kBothSides) const {
    const Vec3 o = frame_.to_local(wo), i = frame_.to_local(wi);
    return sides_agree(wo, wi, o.z, i.z) ? bsdf_.pdf(o, i, mode, sides) : 0.0f;
  }

  std::optional<BsdfSample> sample(Vec3 wo, Vec3 u, TransportMode mode, HashStream& rng,
                                   Lobe sides = kBothSides) const {
    const Vec3 o = frame_.to_local(wo);
    std::optional<BsdfSample> s = bsdf_.sample(o, u, mode, rng, sides);
    if (!s) return {};
    const float cos_i = s->wi.z;
    s->wi = frame_.to_world(s->wi);
    if (!sides_agree(wo, s->wi, o.z, cos_i)) return {};
    s->weight *= adjoint_factor(wo, s->wi, o.z, cos_i, mode);
    return s;
  }

 private:
  bool sides_agree(Vec3 wo, Vec3 wi, float cos_o, float cos_i) const {
    return cos_o * cos_i * (dot(wo, ng_) * dot(wi, ng_)) > 0.0f;
  }
  float adjoint_factor(Vec3 wo, Vec3 wi, float cos_o, float cos_i, TransportMode mode) const {
    if (mode == TransportMode::kRadiance) return 1.0f;
    return std::abs(cos_o * dot(wi, ng_) / (cos_i * dot(wo, ng_)));
  }

  const Bsdf bsdf_;
  Frame frame_;
  Vec3 ng_;
};

}  // namespace etd
