// The list of materials. To add one: its header, and its name in the list.
#pragma once

#include "materials/coated.h"
#include "materials/conductor.h"
#include "materials/dielectric.h"
#include "materials/diffuse.h"
#include "materials/diffuse_transmission.h"
#include "materials/interface.h"
#include "materials/mix.h"
#include "materials/thin_dielectric.h"

namespace etd {

using Materials = TypeList<DiffuseMaterial, ConductorMaterial, DielectricMaterial, ThinDielectricMaterial,
                           DiffuseTransmissionMaterial, MixMaterial, CoatedDiffuseMaterial, CoatedConductorMaterial,
                           InterfaceMaterial>;

template <class T>
Material::Material(const T& material) {
  storage_.store<Materials>(material);
}

}  // namespace etd
