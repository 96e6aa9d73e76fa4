// The list of closures, for those who make them. To add one: its header, and its name in the list.
#pragma once

#include "bsdfs/coated_lambert.h"
#include "bsdfs/coated_mirror.h"
#include "bsdfs/conductor.h"
#include "bsdfs/dielectric.h"
#include "bsdfs/diffuse_transmission.h"
#include "bsdfs/energy.h"
#include "bsdfs/lambert.h"
#include "bsdfs/layered.h"
#include "bsdfs/rough_dielectric.h"
#include "bsdfs/thin_dielectric.h"

namespace etd {

using Closures = TypeList<Lambert, SmoothConductor, RoughConductor, SmoothDielectric, RoughDielectric, ThinDielectric,
                          DiffuseTransmission, EnergyCompensated<RoughConductor>, EnergyCompensated<RoughDielectric>,
                          CoatedLambert<SmoothCoat>, CoatedLambert<RoughCoat>, CoatedMirror,
                          Layered<SmoothDielectric, Lambert>, Layered<RoughDielectric, Lambert>,
                          Layered<SmoothDielectric, SmoothConductor>, Layered<SmoothDielectric, RoughConductor>,
                          Layered<RoughDielectric, SmoothConductor>, Layered<RoughDielectric, RoughConductor>>;

template <class T>
Bsdf::Bsdf(const T& closure) : lobes_(closure.lobes()) {
  storage_.store<Closures>(closure);
}

}  // namespace etd
