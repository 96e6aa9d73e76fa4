// The family of textures: values over a surface. Float textures are the same models with one value in all lanes.
// Textures refer to their children by index into the table that owns them all.
#pragma once

#include <memory>
#include <vector>

#include "core/tagged.h"
#include "core/vec.h"
#include "io/image.h"
#include "spectrum/spectrum.h"

namespace etd {

// Where on the surface a texture is looked up.
struct TexCoord {
  Vec2 uv;
};

// A parameter that may be textured: a constant, or a texture of the table.
struct SpectrumSource {
  Spectrum value;
  int32_t texture = -1;
};
struct FloatSource {
  float value = 0;
  int32_t texture = -1;
};

class TextureTable;

class Texture {
 public:
  template <class T>
  explicit Texture(const T& texture);
  Spectrum eval(const TexCoord& at, const TextureTable& table) const;

 private:
  TaggedStorage<96> storage_;
};

// All textures and images of a scene; const while rendering.
class TextureTable {
 public:
  Spectrum eval(const SpectrumSource& source, const TexCoord& at) const {
    return source.texture < 0 ? source.value : textures[static_cast<size_t>(source.texture)].eval(at, *this);
  }
  float eval(const FloatSource& source, const TexCoord& at) const {
    return source.texture < 0 ? source.value : textures[static_cast<size_t>(source.texture)].eval(at, *this)[0];
  }
  size_t image_bytes() const;

  std::vector<Texture> textures;
  std::vector<Image> images;
};

}  // namespace etd
