// Clear glass and other smooth insulators.
#pragma once

#include "bsdfs/dielectric.h"
#include "materials/material.h"

namespace etd {

struct DielectricMaterial {
  float eta = 1.5f;

  static const ModelDecl& decl();
  static DielectricMaterial create(const ParamReader& p, TextureBuilder& b);

  Bsdf closure(const TexCoord&, const TextureTable&) const { return Bsdf(SmoothDielectric{eta}); }
};

}  // namespace etd
