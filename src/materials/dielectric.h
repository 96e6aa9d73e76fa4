// Clear glass and other insulators, smooth or frosted.
#pragma once

#include "bsdfs/bsdf_list.h"
#include "bsdfs/roughness.h"
#include "materials/material.h"
#include "materials/parameters.h"

namespace etd {

struct DielectricMaterial {
  float eta = 1.5f;
  RoughnessSource roughness;
  bool remap = true;
  const EnergyTable* energy = nullptr;  // null: single scattering alone

  static const ModelDecl& decl();
  static DielectricMaterial create(const ParamReader& p, TextureBuilder& b);

  Bsdf closure(const TexCoord& at, const TextureTable& textures, const ShadingContext& context) const {
    const auto alpha =
        microfacet_alpha(textures.eval(roughness.u, at, context), textures.eval(roughness.v, at, context), remap);
    if (!alpha || eta == 1.0f) return Bsdf(SmoothDielectric{eta});
    const RoughDielectric rough{eta, {alpha->x, alpha->y}};
    return energy ? Bsdf(EnergyCompensated<RoughDielectric>{rough, energy}) : Bsdf(rough);
  }
};

}  // namespace etd
