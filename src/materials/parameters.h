// Declared parameters that several materials share.
#pragma once

#include "params/declaration.h"
#include "textures/resolve.h"

namespace etd {

// Roughness along both directions, or along u and v, as parameters "roughness", "uroughness" and "vroughness" with a
// prefix ("interface.", or none), and the closure's widths.
struct RoughnessSource {
  FloatSource u, v;

  static std::vector<ParamDecl> params(const std::string& prefix, double default_value, const std::string& of);
  static RoughnessSource create(const ParamReader& p, TextureBuilder& b, const std::string& prefix);
};

// The switch between roughness and microfacet alpha.
ParamDecl remap_param();

// The switch that adds the light of repeated scattering between microfacets (bsdfs/energy.h).
ParamDecl energy_param();

// Index of refraction of a clear medium: a number, a flat spectrum, or a named glass at 587.6 nm. Indices that differ
// between colours are unsupported and become their mean.
ParamDecl clear_index_param(const std::string& name, const std::string& doc);
float clear_index(const ParamReader& p, std::string_view name);

// A declaration with what every material has (materials/surface_detail.h).
ModelDecl with_detail(ModelDecl decl);

}  // namespace etd
