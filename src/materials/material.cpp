// The list of materials and their dispatch. To add one: its header, its name in the lists, its constructor line.
#include "materials/material.h"

#include "materials/conductor.h"
#include "materials/dielectric.h"
#include "materials/diffuse.h"
#include "materials/interface.h"

namespace etd {

namespace {
using Materials = TypeList<DiffuseMaterial, ConductorMaterial, DielectricMaterial>;
}  // namespace

template <class T>
Material::Material(const T& material) {
  storage_.store<Materials>(material);
}
template Material::Material(const DiffuseMaterial&);
template Material::Material(const ConductorMaterial&);
template Material::Material(const DielectricMaterial&);

Bsdf Material::closure(const TexCoord& at, const TextureTable& textures) const {
  return dispatch<Bsdf, Materials>(storage_, [&](const auto& m) { return m.closure(at, textures); });
}

std::span<const ModelDecl* const> material_models() {
  static const ModelDecl* const all[] = {&DiffuseMaterial::decl(), &ConductorMaterial::decl(),
                                         &DielectricMaterial::decl(), &interface_decl()};
  return all;
}

std::optional<Material> make_material(const ModelUse& use, TextureBuilder& textures, Diagnostics& diagnostics) {
  if (use.model == "interface") return {};
  if (use.model == "conductor")
    return Material(ConductorMaterial::create({ConductorMaterial::decl(), use, diagnostics}, textures));
  if (use.model == "dielectric")
    return Material(DielectricMaterial::create({DielectricMaterial::decl(), use, diagnostics}, textures));
  return Material(DiffuseMaterial::create({DiffuseMaterial::decl(), use, diagnostics}, textures));
}

}  // namespace etd
