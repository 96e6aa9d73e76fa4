// Two materials in one place, for instance paint that has peeled off: at each path vertex one of them is there, chosen
// at random with the probability that the texture says. The mean is the blend of both, with the noise of choosing.
#pragma once

#include <map>

#include "materials/material.h"

namespace etd {

struct MixMaterial {
  FloatSource amount;
  uint32_t children[2] = {0, 0};  // in the scene's materials

  static const ModelDecl& decl();
  static MixMaterial create(const ParamReader& p, TextureBuilder& b, const MaterialNames& names);

  uint32_t choose(const TexCoord& at, const TextureTable& textures, const ShadingContext& context, float u) const {
    return children[u < textures.eval(amount, at, context) ? 1 : 0];
  }
  // Is never what a ray meets: choose() comes first.
  Bsdf closure(const TexCoord&, const TextureTable&, const ShadingContext&) const { return Bsdf(); }
};

}  // namespace etd
