// The surface that is not there: only a border between media. compile() leaves such shapes out while there are none.
#pragma once

#include "materials/material.h"

namespace etd {

// It has no create(), because there is nothing to make.
struct InterfaceMaterial {
  static const ModelDecl& decl() {
    static const ModelDecl d{
        Family::kMaterial, "interface", "No surface: light passes unchanged. Separates participating media.", {}};
    return d;
  }
  // Is never what a ray meets.
  Bsdf closure(const TexCoord&, const TextureTable&, const ShadingContext&) const { return Bsdf(); }
};

}  // namespace etd
