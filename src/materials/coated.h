// Varnished wood, car paint, lacquered metal: a diffuse surface or a metal under a clear or milky coat.
#pragma once

#include <optional>

#include "bsdfs/coat_table.h"
#include "materials/material.h"
#include "materials/parameters.h"

namespace etd {

// What both have: the coat.
struct CoatSource {
  RoughnessSource roughness;
  FloatSource thickness, g;
  SpectrumSource albedo;
  float eta = 1.5f;
  int32_t max_depth = 10, samples = 1;

  // `prefix` is "" or "interface.", before roughness, thickness and eta.
  static std::vector<ParamDecl> params(const std::string& prefix);
  static CoatSource create(const ParamReader& p, TextureBuilder& b, const std::string& prefix);

  // Whether its medium only absorbs, everywhere.
  bool only_absorbs() const { return albedo.texture < 0 && is_black(albedo.value); }
};

struct CoatedDiffuseMaterial {
  SpectrumSource reflectance;
  CoatSource coat;
  bool remap = true;
  // One of them where the closure has a closed form: the coat only absorbs and is the same everywhere and in all
  // directions.
  std::optional<CoatMeans> smooth;
  const CoatTable* rough = nullptr;

  static const ModelDecl& decl();
  static CoatedDiffuseMaterial create(const ParamReader& p, TextureBuilder& b, MaterialData& data);
  Bsdf closure(const TexCoord& at, const TextureTable& textures, const ShadingContext& context) const;
};

struct CoatedConductorMaterial {
  SpectrumSource eta, k;       // or, when `by_reflectance`,
  SpectrumSource reflectance;  // at normal incidence from inside of the coat
  RoughnessSource roughness;
  CoatSource coat;
  bool by_reflectance = false, remap = true;

  static const ModelDecl& decl();
  static CoatedConductorMaterial create(const ParamReader& p, TextureBuilder& b);
  Bsdf closure(const TexCoord& at, const TextureTable& textures, const ShadingContext& context) const;
};

}  // namespace etd
