// The family of materials: what a scene names. A material evaluates its textures at a point into a closure.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>

#include "bsdfs/bsdf.h"
#include "materials/surface_detail.h"
#include "textures/resolve.h"

namespace etd {

struct MaterialData;

class Material {
 public:
  template <class T>
  explicit Material(const T& material);
  // The closure, where it is the same in every place and in every frame around the shading normal, which is then that
  // of the surface: no texture and no tangent matters. Otherwise null.
  const Bsdf* plain() const { return plain_ ? &*plain_ : nullptr; }
  // Returns the closure of any material but a mix, for which resolve() comes first.
  Bsdf closure(const TexCoord& at, const TextureTable& textures, const ShadingContext& context) const;

  // The material itself, or of a mix the one of `all` that is chosen, down to one that is no mix. Takes one number of
  // the stream for each choice.
  const Material& resolve(const TexCoord& at, const TextureTable& textures, const ShadingContext& context,
                          std::span<const Material> all, HashStream& rng) const;
  // The materials that this one refers to, as indices.
  std::span<const uint32_t> children() const;
  // The frame in which the closure scatters at a point.
  Frame frame(const SurfacePoint& point, const TexCoord& at, const TextureTable& textures,
              const ShadingContext& context) const {
    return detail.frame(point, at, textures, context);
  }

  SurfaceDetail detail;

  // Keeps the closure, if it is plain; call it of a material without textures.
  void keep_closure();

 private:
  TaggedStorage<240> storage_;
  std::optional<Bsdf> plain_;
};

// Says where the named materials of a scene stand in its array; nothing for those that are no surface.
using MaterialNames = std::map<std::string, std::optional<uint32_t>, std::less<>>;

std::span<const ModelDecl* const> material_models();
// Makes the material of a checked use; nothing for "interface", which is no surface at all. `data` must outlive it.
std::optional<Material> make_material(const ModelUse& use, TextureBuilder& textures, MaterialData& data,
                                      Diagnostics& diagnostics, const MaterialNames& names = {});

}  // namespace etd
