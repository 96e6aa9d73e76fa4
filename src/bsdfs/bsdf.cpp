#include "bsdfs/bsdf.h"

#include "bsdfs/bsdf_list.h"

namespace etd {

Spectrum Bsdf::eval_cos(Vec3 wo, Vec3 wi, TransportMode mode, HashStream& rng) const {
  return dispatch<Spectrum, Closures>(storage_, [&](const auto& c) { return c.eval_cos(wo, wi, mode, rng); });
}

float Bsdf::pdf(Vec3 wo, Vec3 wi, TransportMode mode, Lobe sides) const {
  return dispatch<float, Closures>(storage_, [&](const auto& c) { return c.pdf(wo, wi, mode, sides); });
}

std::optional<BsdfSample> Bsdf::sample(Vec3 wo, Vec3 u, TransportMode mode, HashStream& rng, Lobe sides) const {
  return dispatch<std::optional<BsdfSample>, Closures>(
      storage_, [&](const auto& c) { return c.sample(wo, u, mode, rng, sides); });
}

BsdfValue Bsdf::eval_pdf(Vec3 wo, Vec3 wi, HashStream& rng) const {
  return dispatch<BsdfValue, Closures>(storage_, [&](const auto& c) {
    return BsdfValue{c.eval_cos(wo, wi, TransportMode::kRadiance, rng),
                     c.pdf(wo, wi, TransportMode::kRadiance, kBothSides)};
  });
}

bool Bsdf::is_isotropic() const {
  return dispatch<bool, Closures>(storage_, [](const auto& c) {
    if constexpr (requires { c.is_isotropic(); })
      return c.is_isotropic();
    else
      return false;
  });
}

float Bsdf::widest_alpha() const {
  return dispatch<float, Closures>(storage_, [](const auto& c) { return c.widest_alpha(); });
}

Spectrum Bsdf::albedo(Vec3 wo) const {
  return dispatch<Spectrum, Closures>(storage_, [&](const auto& c) { return c.albedo(wo); });
}

BsdfTraits Bsdf::traits() const {
  return dispatch<BsdfTraits, Closures>(storage_, [](const auto& c) { return c.kTraits; });
}

uint32_t Bsdf::kind_count() { return static_cast<uint32_t>(Closures::kCount); }

}  // namespace etd
