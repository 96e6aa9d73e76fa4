// The list of textures, their dispatch and their building. To add one: its header, its name in the list.
#include "textures/texture.h"

#include <fmt/format.h>

#include <set>

#include "textures/bilerp.h"
#include "textures/checkerboard.h"
#include "textures/constant.h"
#include "textures/direction_mix.h"
#include "textures/dots.h"
#include "textures/fbm.h"
#include "textures/imagemap.h"
#include "textures/marble.h"
#include "textures/mix.h"
#include "textures/resolve.h"
#include "textures/scale.h"
#include "textures/windy.h"
#include "textures/wrinkled.h"

namespace etd {

namespace {
using Textures =
    TypeList<ConstantTexture, ScaleTexture, MixTexture, DirectionMixTexture, BilerpTexture, ImageMapTexture,
             CheckerboardTexture, DotsTexture, FbmTexture, WrinkledTexture, WindyTexture, MarbleTexture>;
}  // namespace

template <class T>
Texture::Texture(const T& texture) {
  storage_.store<Textures>(texture);
}
template Texture::Texture(const ImageMapTexture&);

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

template <class... Ts>
std::vector<const ModelDecl*> declarations(TypeList<Ts...>) {
  return {&Ts::decl()...};
}

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

template <class... Ts>
Texture make_texture(TypeList<Ts...>, const ModelUse& use, TextureBuilder& builder, Diagnostics& diagnostics) {
  Texture texture(ConstantTexture{Spectrum(0.5f)});  // of an unknown model, which has been reported
  const auto make = [&](const auto* none) {
    using T = std::remove_const_t<std::remove_pointer_t<decltype(none)>>;
    if (use.model != T::decl().name) return;
    const ParamReader params(T::decl(), use, diagnostics);
    check_kind<T>(params, builder);
    texture = Texture(T::create(params, builder));
  };
  (make(static_cast<const Ts*>(nullptr)), ...);
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
  const Texture texture = make_texture(Textures{}, use, *this, diagnostics);
  is_float_ = false;
  names_[{name, is_float}] = static_cast<int32_t>(table_.textures.size());
  table_.textures.push_back(texture);
}

}  // namespace etd
