// The family of textures: values over a surface. Float textures are the same models with one value in all lanes.
// Textures refer to their children by index into the table that owns them all.
#pragma once

#include <memory>
#include <vector>

#include "core/affine.h"
#include "core/tagged.h"
#include "spectrum/shading_context.h"
#include "spectrum/spectrum.h"
#include "textures/texture_image.h"

namespace etd {

// Says where on a surface a texture is looked up, and over how much of it: the footprint is the parallelogram that one
// step of a pixel along each axis of the film covers. Zero is a point.
struct TexCoord {
  Vec2 uv;
  Point3 p = {};                  // in the recentred world
  Vec3 n = {};                    // unit geometric normal, on either side
  Vec3 dp_dx = {}, dp_dy = {};    // change of p
  Vec2 duv_dx = {}, duv_dy = {};  // and of uv, over the footprint
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
  Spectrum eval(const TexCoord& at, const TextureTable& table, const ShadingContext& context) const;

 private:
  TaggedStorage<128> storage_;
};

// All textures and images of a scene; const while rendering.
class TextureTable {
 public:
  Spectrum eval(const SpectrumSource& source, const TexCoord& at, const ShadingContext& context) const {
    return source.texture < 0 ? source.value : textures[static_cast<size_t>(source.texture)].eval(at, *this, context);
  }
  float eval(const FloatSource& source, const TexCoord& at, const ShadingContext& context) const {
    return source.texture < 0 ? source.value
                              : textures[static_cast<size_t>(source.texture)].eval(at, *this, context)[0];
  }
  // The memory that images take now.
  size_t image_bytes() const;

  std::vector<Texture> textures;
  std::shared_ptr<TextureCache> cache;  // null: all images are in memory
  size_t cache_limit = 0;               // of its bytes
  std::vector<TextureImage> images;
  std::vector<Affine> spaces;  // from the recentred world to the space in which a texture was defined
};

}  // namespace etd
