#include "io/texture_cache.h"

#include "io/image_codecs.h"

namespace etd {

std::string write_tiled_levels(const std::filesystem::path& path, const TiledInfo& info,
                               const std::function<const Image*()>& next) {
  try {
    return image_codecs().write_tiled_levels(path, info, next);
  } catch (const std::exception& error) {
    return error.what();
  }
}

TextureCache::TextureCache(size_t bytes) : tiles_(image_codecs().tile_cache(bytes)) {}
TextureCache::~TextureCache() = default;

std::shared_ptr<const CachedImage> TextureCache::open(const std::filesystem::path& path, std::string& error) {
  return tiles_->open(path, error);
}

size_t TextureCache::bytes_in_use() const { return tiles_->bytes_in_use(); }

std::string TextureCache::read_error() const { return tiles_->read_error(); }

void CachedTexels::fetch(int level, int tile_x, int tile_y) {
  release();
  level_ = level, tile_x_ = tile_x, tile_y_ = tile_y;
  texels_ = image_.tiles_->hold(image_, level, tile_x, tile_y, tile_);
}

void CachedTexels::release() {
  if (tile_) image_.tiles_->release(tile_);
  tile_ = nullptr;
  texels_ = nullptr;
}

}  // namespace etd
