// The list of textures, their dispatch and their building. To add one: its header, its name in the lists, its
// constructor line.
#include "textures/texture.h"

#include <fmt/format.h>

#include "textures/checkerboard.h"
#include "textures/constant.h"
#include "textures/imagemap.h"
#include "textures/resolve.h"
#include "textures/scale.h"

namespace etd {

namespace {
using Textures = TypeList<ConstantTexture, ScaleTexture, CheckerboardTexture, ImageMapTexture>;
}  // namespace

template <class T>
Texture::Texture(const T& texture) {
  storage_.store<Textures>(texture);
}
template Texture::Texture(const ConstantTexture&);
template Texture::Texture(const ScaleTexture&);
template Texture::Texture(const CheckerboardTexture&);
template Texture::Texture(const ImageMapTexture&);

Spectrum Texture::eval(const TexCoord& at, const TextureTable& table) const {
  return dispatch<Spectrum, Textures>(storage_, [&](const auto& t) { return t.eval(at, table); });
}

size_t TextureTable::image_bytes() const {
  size_t sum = 0;
  for (const Image& image : images) sum += image.bytes();
  return sum;
}

std::span<const ModelDecl* const> texture_models() {
  static const ModelDecl* const all[] = {&ConstantTexture::decl(), &ScaleTexture::decl(), &CheckerboardTexture::decl(),
                                         &ImageMapTexture::decl()};
  return all;
}

int32_t TextureBuilder::image_texture(const Param& filename, std::string_view encoding, Diagnostics& diagnostics) {
  ImageMapTexture texture;
  texture.image = image(filename, encoding, diagnostics);
  if (texture.image < 0) return -1;
  table_.textures.push_back(Texture(texture));
  return static_cast<int32_t>(table_.textures.size()) - 1;
}

void TextureBuilder::add(const std::string& name, bool is_float, const ModelUse& use, Diagnostics& diagnostics) {
  inside_float_ = is_float;
  Texture texture(ConstantTexture{Spectrum(0.5f)});
  if (use.model == "constant")
    texture = Texture(ConstantTexture::create({ConstantTexture::decl(), use, diagnostics}, *this));
  else if (use.model == "scale")
    texture = Texture(ScaleTexture::create({ScaleTexture::decl(), use, diagnostics}, *this));
  else if (use.model == "checkerboard")
    texture = Texture(CheckerboardTexture::create({CheckerboardTexture::decl(), use, diagnostics}, *this));
  else if (use.model == "imagemap") {
    const ImageMapTexture t = ImageMapTexture::create({ImageMapTexture::decl(), use, diagnostics}, *this, is_float);
    if (t.image >= 0) texture = Texture(t);
  }
  inside_float_ = false;
  names_[{name, is_float}] = static_cast<int32_t>(table_.textures.size());
  table_.textures.push_back(texture);
}

}  // namespace etd
