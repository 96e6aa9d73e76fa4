// Metals, smooth or rough.
#pragma once

#include "bsdfs/bsdf_list.h"
#include "bsdfs/roughness.h"
#include "materials/material.h"
#include "materials/parameters.h"

namespace etd {

// The absorption with which a metal of index 1 has this reflectance at normal incidence: k^2 / (4 + k^2).
inline Spectrum absorption_of_reflectance(const Spectrum& reflectance) {
  Spectrum k;
  for (int i = 0; i < Spectrum::kLanes; ++i) {
    const float r = clamp(reflectance[i], 0.0f, 0.9999f);
    k.v[i] = 2.0f * std::sqrt(r / (1.0f - r));
  }
  return k;
}

struct ConductorMaterial {
  SpectrumSource eta, k;       // or, when `by_reflectance`,
  SpectrumSource reflectance;  // at normal incidence
  RoughnessSource roughness;
  bool by_reflectance = false, remap = true;
  const EnergyTable* energy = nullptr;  // null: single scattering alone

  static const ModelDecl& decl();
  static ConductorMaterial create(const ParamReader& p, TextureBuilder& b);

  Bsdf closure(const TexCoord& at, const TextureTable& textures, const ShadingContext& context) const {
    Spectrum n(1.0f), kappa;
    if (by_reflectance) {
      kappa = absorption_of_reflectance(textures.eval(reflectance, at, context));
    } else {
      n = textures.eval(eta, at, context);
      kappa = textures.eval(k, at, context);
    }
    const auto alpha =
        microfacet_alpha(textures.eval(roughness.u, at, context), textures.eval(roughness.v, at, context), remap);
    if (!alpha) return Bsdf(SmoothConductor{n, kappa});
    const RoughConductor rough{n, kappa, {alpha->x, alpha->y}};
    return energy ? Bsdf(EnergyCompensated<RoughConductor>{rough, energy}) : Bsdf(rough);
  }
};

}  // namespace etd
