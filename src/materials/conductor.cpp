#include "materials/conductor.h"

namespace etd {

const ModelDecl& ConductorMaterial::decl() {
  static const ModelDecl d = [] {
    ModelDecl m{Family::kMaterial,
                "conductor",
                "Metal: mirror or GGX microfacets with the Fresnel reflectance of a complex index of refraction.",
                {{.name = "eta",
                  .type = ParamType::kSpectrumTexture,
                  .default_value = std::string("metal-Cu-eta"),
                  .min = 0,
                  .above_min = true,
                  .doc = "Index of refraction; copper by default."},
                 {.name = "k",
                  .type = ParamType::kSpectrumTexture,
                  .default_value = std::string("metal-Cu-k"),
                  .min = 0,
                  .doc = "Absorption coefficient; copper by default."},
                 {.name = "reflectance",
                  .type = ParamType::kSpectrumTexture,
                  .min = 0,
                  .max = 1,
                  .clamp = true,
                  .doc = "Reflectance at normal incidence, instead of eta and k."}}};
    return with_detail(
        with_params(m, {RoughnessSource::params("", 0.0, "of the surface"), {remap_param(), energy_param()}}));
  }();
  return d;
}

ConductorMaterial ConductorMaterial::create(const ParamReader& p, TextureBuilder& b) {
  ConductorMaterial m;
  m.by_reflectance = p.given("reflectance") != nullptr;
  if (m.by_reflectance) {
    for (const char* other : {"eta", "k"})
      if (const Param* given = p.given(other))
        p.diagnostics().error(given->loc, "a conductor has either \"reflectance\" or \"eta\" and \"k\"",
                              "leave out one of them");
    m.reflectance = b.spectrum(p, "reflectance");
  } else {
    m.eta = b.spectrum(p, "eta");
    m.k = b.spectrum(p, "k");
  }
  m.roughness = RoughnessSource::create(p, b, "");
  m.remap = p.boolean("remaproughness");
  if (p.boolean("energycompensation")) m.energy = &mirror_energy();
  return m;
}

}  // namespace etd
