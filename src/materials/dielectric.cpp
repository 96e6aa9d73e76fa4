#include "materials/dielectric.h"

namespace etd {

const ModelDecl& DielectricMaterial::decl() {
  static const ModelDecl d = [] {
    ModelDecl m{Family::kMaterial,
                "dielectric",
                "Glass: reflects and refracts as Fresnel says, smooth or with GGX microfacets.",
                {clear_index_param("eta", "Index of refraction inside over outside")}};
    return with_detail(
        with_params(m, {RoughnessSource::params("", 0.0, "of the surface"), {remap_param(), energy_param()}}));
  }();
  return d;
}

DielectricMaterial DielectricMaterial::create(const ParamReader& p, TextureBuilder& b) {
  DielectricMaterial m{clear_index(p, "eta"), RoughnessSource::create(p, b, ""), p.boolean("remaproughness")};
  if (p.boolean("energycompensation") && m.eta != 1.0f) m.energy = &dielectric_energy(m.eta);
  return m;
}

}  // namespace etd
