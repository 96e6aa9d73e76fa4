#include "textures/texture.h"

#include <fmt/format.h>

#include <set>

#include "params/model_list.h"
#include "textures/resolve.h"
#include "textures/texture_list.h"

namespace etd {

Spectrum Texture::eval(const TexCoord& at, const TextureTable& table, const ShadingContext& context) const {
  return dispatch<Spectrum, Textures>(storage_, [&](const auto& t) { return t.eval(at, table, context); });
}

size_t TextureTable::image_bytes() const {
  if (cache) return cache->bytes_in_use();
  size_t sum = 0;
  std::set<const Image*> counted;
  for (const TextureImage& image : images) {
    if (image.finest() && counted.insert(image.finest().get()).second) sum += image.finest()->bytes();
    for (const Image& level : image.coarser()) sum += level.bytes();
  }
  return sum;
}

namespace {

// Reports a kind of texture that the model does not make.
template <class T>
void check_kind(const ParamReader& p, const TextureBuilder& builder) {
  if constexpr (requires { T::kKind; }) {
    const bool only_float = T::kKind == TextureKind::kFloat;
    if (builder.is_float() != only_float)
      p.diagnostics().error(
          p.use().loc,
          fmt::format("there is no {} texture \"{}\"", builder.is_float() ? "float" : "spectrum", p.use().model),
          fmt::format("\"{}\" is a {} texture", p.use().model, only_float ? "float" : "spectrum"));
  }
}

Texture make_texture(const ModelUse& use, TextureBuilder& builder, Diagnostics& diagnostics) {
  Texture texture(ConstantTexture{Spectrum(0.5f)});  // of an unknown model, which has been reported
  with_model(Textures{}, use, diagnostics, [&]<class T>(std::type_identity<T>, const ParamReader& p) {
    check_kind<T>(p, builder);
    texture = Texture(T::create(p, builder));
  });
  return texture;
}

}  // namespace

std::span<const ModelDecl* const> texture_models() {
  static const std::vector<const ModelDecl*> all = declarations(Textures{});
  return all;
}

int32_t TextureBuilder::image_texture(const Param& filename, std::string_view encoding, const std::string& layer,
                                      Diagnostics& diagnostics) {
  ImageMapTexture texture;
  texture.image = images_.add(filename, encoding, layer, {}, diagnostics);
  if (texture.image < 0) return -1;
  table_.textures.push_back(Texture(texture));
  return static_cast<int32_t>(table_.textures.size()) - 1;
}

void TextureBuilder::add(const std::string& name, bool is_float, const ModelUse& use, const Transform& to_world,
                         Diagnostics& diagnostics) {
  is_float_ = is_float;
  to_world_ = to_world;
  const Texture texture = make_texture(use, *this, diagnostics);
  is_float_ = false;
  names_[{name, is_float}] = static_cast<int32_t>(table_.textures.size());
  table_.textures.push_back(texture);
}

}  // namespace etd
