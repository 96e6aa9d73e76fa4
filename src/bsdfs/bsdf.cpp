// The list of closures and their dispatch. To add one: its header, its name in the list, its constructor line.
#include "bsdfs/bsdf.h"

#include "bsdfs/conductor.h"
#include "bsdfs/dielectric.h"
#include "bsdfs/diffuse_transmission.h"
#include "bsdfs/energy.h"
#include "bsdfs/lambert.h"
#include "bsdfs/layered.h"
#include "bsdfs/rough_dielectric.h"
#include "bsdfs/thin_dielectric.h"

namespace etd {

namespace {
using Closures = TypeList<Lambert, SmoothConductor, RoughConductor, SmoothDielectric, RoughDielectric, ThinDielectric,
                          DiffuseTransmission, EnergyCompensated<RoughConductor>, EnergyCompensated<RoughDielectric>,
                          Layered<SmoothDielectric, Lambert>, Layered<RoughDielectric, Lambert>,
                          Layered<SmoothDielectric, SmoothConductor>, Layered<SmoothDielectric, RoughConductor>,
                          Layered<RoughDielectric, SmoothConductor>, Layered<RoughDielectric, RoughConductor>>;
}  // namespace

template <class T>
Bsdf::Bsdf(const T& closure) {
  storage_.store<Closures>(closure);
}
template Bsdf::Bsdf(const Lambert&);
template Bsdf::Bsdf(const SmoothConductor&);
template Bsdf::Bsdf(const RoughConductor&);
template Bsdf::Bsdf(const SmoothDielectric&);
template Bsdf::Bsdf(const RoughDielectric&);
template Bsdf::Bsdf(const ThinDielectric&);
template Bsdf::Bsdf(const DiffuseTransmission&);
template Bsdf::Bsdf(const EnergyCompensated<RoughConductor>&);
template Bsdf::Bsdf(const EnergyCompensated<RoughDielectric>&);
template Bsdf::Bsdf(const Layered<SmoothDielectric, Lambert>&);
template Bsdf::Bsdf(const Layered<RoughDielectric, Lambert>&);
template Bsdf::Bsdf(const Layered<SmoothDielectric, SmoothConductor>&);
template Bsdf::Bsdf(const Layered<SmoothDielectric, RoughConductor>&);
template Bsdf::Bsdf(const Layered<RoughDielectric, SmoothConductor>&);
template Bsdf::Bsdf(const Layered<RoughDielectric, RoughConductor>&);

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

Lobe Bsdf::lobes() const {
  return dispatch<Lobe, Closures>(storage_, [](const auto& c) { return c.lobes(); });
}

Spectrum Bsdf::albedo(Vec3 wo) const {
  return dispatch<Spectrum, Closures>(storage_, [&](const auto& c) { return c.albedo(wo); });
}

BsdfTraits Bsdf::traits() const {
  return dispatch<BsdfTraits, Closures>(storage_, [](const auto& c) { return c.kTraits; });
}

uint32_t Bsdf::kind_count() { return static_cast<uint32_t>(Closures::kCount); }

}  // namespace etd
