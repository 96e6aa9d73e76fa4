// The list of materials and their dispatch. To add one: its header, its name in the lists, its constructor line.
#include "materials/material.h"

#include "materials/coated.h"
#include "materials/conductor.h"
#include "materials/dielectric.h"
#include "materials/diffuse.h"
#include "materials/diffuse_transmission.h"
#include "materials/interface.h"
#include "materials/mix.h"
#include "materials/thin_dielectric.h"

namespace etd {

namespace {
using Materials = TypeList<DiffuseMaterial, ConductorMaterial, DielectricMaterial, ThinDielectricMaterial,
                           DiffuseTransmissionMaterial, MixMaterial, CoatedDiffuseMaterial, CoatedConductorMaterial>;
constexpr uint32_t kMix = Materials::index_of<MixMaterial>();
}  // namespace

template <class T>
Material::Material(const T& material) {
  storage_.store<Materials>(material);
}
template Material::Material(const DiffuseMaterial&);
template Material::Material(const ConductorMaterial&);
template Material::Material(const DielectricMaterial&);
template Material::Material(const ThinDielectricMaterial&);
template Material::Material(const DiffuseTransmissionMaterial&);
template Material::Material(const MixMaterial&);
template Material::Material(const CoatedDiffuseMaterial&);
template Material::Material(const CoatedConductorMaterial&);

Bsdf Material::closure(const TexCoord& at, const TextureTable& textures, const ShadingContext& context) const {
  return dispatch<Bsdf, Materials>(storage_, [&](const auto& m) { return m.closure(at, textures, context); });
}

namespace {
const MixMaterial* as_mix(const TaggedStorage<240>& storage) {
  return storage.tag == kMix ? std::launder(reinterpret_cast<const MixMaterial*>(storage.bytes)) : nullptr;
}
}  // namespace

const Material& Material::resolve(const TexCoord& at, const TextureTable& textures, const ShadingContext& context,
                                  std::span<const Material> all, HashStream& rng) const {
  const Material* m = this;
  while (const MixMaterial* mix = as_mix(m->storage_)) m = &all[mix->choose(at, textures, context, rng.next_float())];
  return *m;
}

std::span<const uint32_t> Material::children() const {
  const MixMaterial* mix = as_mix(storage_);
  return mix ? std::span<const uint32_t>(mix->children) : std::span<const uint32_t>();
}

std::span<const ModelDecl* const> material_models() {
  static const ModelDecl* const all[] = {
      &DiffuseMaterial::decl(),        &ConductorMaterial::decl(),           &DielectricMaterial::decl(),
      &ThinDielectricMaterial::decl(), &DiffuseTransmissionMaterial::decl(), &MixMaterial::decl(),
      &CoatedDiffuseMaterial::decl(),  &CoatedConductorMaterial::decl(),     &interface_decl()};
  return all;
}

namespace {
template <class T>
Material make(const ModelUse& use, TextureBuilder& textures, Diagnostics& diagnostics) {
  const ParamReader params(T::decl(), use, diagnostics);
  Material material(T::create(params, textures));
  material.detail = SurfaceDetail::create(params, textures);
  return material;
}
}  // namespace

std::optional<Material> make_material(const ModelUse& use, TextureBuilder& textures, Diagnostics& diagnostics,
                                      const MaterialNames& names) {
  if (use.model == "interface") return {};
  if (use.model == "conductor") return make<ConductorMaterial>(use, textures, diagnostics);
  if (use.model == "dielectric") return make<DielectricMaterial>(use, textures, diagnostics);
  if (use.model == "thindielectric") return make<ThinDielectricMaterial>(use, textures, diagnostics);
  if (use.model == "diffusetransmission") return make<DiffuseTransmissionMaterial>(use, textures, diagnostics);
  if (use.model == "coateddiffuse") return make<CoatedDiffuseMaterial>(use, textures, diagnostics);
  if (use.model == "coatedconductor") return make<CoatedConductorMaterial>(use, textures, diagnostics);
  if (use.model == "mix")
    return Material(MixMaterial::create({MixMaterial::decl(), use, diagnostics}, textures, names));
  return make<DiffuseMaterial>(use, textures, diagnostics);
}

}  // namespace etd
