// Window panes: both surfaces of a thin sheet in one.
#pragma once

#include "bsdfs/bsdf_list.h"
#include "materials/material.h"
#include "materials/parameters.h"

namespace etd {

struct ThinDielectricMaterial {
  float eta = 1.5f;

  static const ModelDecl& decl() {
    static const ModelDecl d =
        with_detail({Family::kMaterial,
                     "thindielectric",
                     "A thin smooth sheet of glass, which light leaves where it entered.",
                     {clear_index_param("eta", "Index of refraction of the sheet over that around it")}});
    return d;
  }
  static ThinDielectricMaterial create(const ParamReader& p, TextureBuilder&) { return {clear_index(p, "eta")}; }

  Bsdf closure(const TexCoord&, const TextureTable&, const ShadingContext&) const { return Bsdf(ThinDielectric{eta}); }
};

}  // namespace etd
