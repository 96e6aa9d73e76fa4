// Matte surfaces.
#pragma once

#include "bsdfs/bsdf_list.h"
#include "materials/material.h"
#include "materials/parameters.h"

namespace etd {

struct DiffuseMaterial {
  SpectrumSource reflectance;

  static const ModelDecl& decl() {
    static const ModelDecl d = with_detail({Family::kMaterial,
                                            "diffuse",
                                            "Reflects the same radiance to all directions, on both sides.",
                                            {{.name = "reflectance",
                                              .type = ParamType::kSpectrumTexture,
                                              .default_value = 0.5,
                                              .min = 0,
                                              .max = 1,
                                              .clamp = true,
                                              .doc = "Share of the light that is reflected."}}});
    return d;
  }
  static DiffuseMaterial create(const ParamReader& p, TextureBuilder& b) { return {b.spectrum(p, "reflectance")}; }

  Bsdf closure(const TexCoord& at, const TextureTable& textures, const ShadingContext& context) const {
    return Bsdf(Lambert{clamp(textures.eval(reflectance, at, context), 0.0f, 1.0f)});
  }
};

}  // namespace etd
