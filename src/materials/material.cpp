#include "materials/material.h"

#include "materials/material_list.h"
#include "params/model_list.h"

namespace etd {

Bsdf Material::closure(const TexCoord& at, const TextureTable& textures, const ShadingContext& context) const {
  return dispatch<Bsdf, Materials>(storage_, [&](const auto& m) { return m.closure(at, textures, context); });
}

void Material::keep_closure() {
  const Bsdf closure = this->closure({}, {}, {});
  if (closure.is_isotropic()) plain_ = closure;
}

namespace {
const MixMaterial* as_mix(const TaggedStorage<240>& storage) {
  constexpr uint32_t kMix = Materials::index_of<MixMaterial>();
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
  static const std::vector<const ModelDecl*> all = declarations(Materials{});
  return all;
}

namespace {

// Nothing of a model that is no surface.
template <class T>
std::optional<Material> make(const ParamReader& params, TextureBuilder& textures, MaterialData& data,
                             const MaterialNames& names) {
  const auto detailed = [&](Material material) {
    material.detail = SurfaceDetail::create(params, textures);
    const auto& given = params.use().params;
    const bool textured =
        std::any_of(given.begin(), given.end(), [](const Param& p) { return p.kind == ParamKind::kTexture; });
    if (!textured && material.detail.normal_map < 0) material.keep_closure();
    return material;
  };
  if constexpr (requires { T::create(params, textures, names); }) {
    return Material(T::create(params, textures, names));  // of other materials, which have their own detail
  } else if constexpr (requires { T::create(params, textures); }) {
    return detailed(Material(T::create(params, textures)));
  } else if constexpr (requires { T::create(params, textures, data); }) {
    return detailed(Material(T::create(params, textures, data)));
  } else {
    return {};
  }
}

}  // namespace

std::optional<Material> make_material(const ModelUse& use, TextureBuilder& textures, MaterialData& data,
                                      Diagnostics& diagnostics, const MaterialNames& names) {
  std::optional<Material> material;
  const auto made = [&]<class T>(std::type_identity<T>, const ParamReader& p) {
    material = make<T>(p, textures, data, names);
  };
  if (!with_model(Materials{}, use, diagnostics, made))
    made(std::type_identity<DiffuseMaterial>(), {DiffuseMaterial::decl(), use, diagnostics});
  return material;
}

}  // namespace etd
