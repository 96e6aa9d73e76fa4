// The family of materials: what a scene names. A material evaluates its textures at a point into a closure.
#pragma once

#include <optional>
#include <span>

#include "bsdfs/bsdf.h"
#include "textures/resolve.h"

namespace etd {

class Material {
 public:
  template <class T>
  explicit Material(const T& material);
  Bsdf closure(const TexCoord& at, const TextureTable& textures) const;

 private:
  TaggedStorage<160> storage_;
};

std::span<const ModelDecl* const> material_models();
// Of a checked use; nothing for "interface", which is no surface at all.
std::optional<Material> make_material(const ModelUse& use, TextureBuilder& textures, Diagnostics& diagnostics);

}  // namespace etd
