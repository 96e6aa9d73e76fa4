// Paper, leaves, lampshades: thin sheets that scatter light to both of their sides.
#pragma once

#include "bsdfs/bsdf_list.h"
#include "materials/material.h"
#include "materials/parameters.h"

namespace etd {

struct DiffuseTransmissionMaterial {
  SpectrumSource reflectance, transmittance;
  float scale = 1;

  static const ModelDecl& decl() {
    static const ModelDecl d =
        with_detail({Family::kMaterial,
                     "diffusetransmission",
                     "A thin sheet with diffuse reflection and diffuse transmission.",
                     {{.name = "reflectance",
                       .type = ParamType::kSpectrumTexture,
                       .default_value = 0.25,
                       .min = 0,
                       .max = 1,
                       .clamp = true,
                       .doc = "Share of the light that is reflected."},
                      {.name = "transmittance",
                       .type = ParamType::kSpectrumTexture,
                       .default_value = 0.25,
                       .min = 0,
                       .max = 1,
                       .clamp = true,
                       .doc = "Share of the light that passes; where both exceed 1 together, they are scaled to 1."},
                      {.name = "scale", .default_value = 1.0, .min = 0, .doc = "Factor on both."}}});
    return d;
  }
  static DiffuseTransmissionMaterial create(const ParamReader& p, TextureBuilder& b) {
    return {b.spectrum(p, "reflectance"), b.spectrum(p, "transmittance"), static_cast<float>(p.number("scale"))};
  }

  Bsdf closure(const TexCoord& at, const TextureTable& textures, const ShadingContext& context) const {
    Spectrum r = max(textures.eval(reflectance, at, context) * scale, 0.0f);
    Spectrum t = max(textures.eval(transmittance, at, context) * scale, 0.0f);
    for (int i = 0; i < Spectrum::kLanes; ++i) {
      const float sum = r[i] + t[i];
      if (sum > 1.0f) r.v[i] /= sum, t.v[i] /= sum;
    }
    return Bsdf(DiffuseTransmission{r, t});
  }
};

}  // namespace etd
