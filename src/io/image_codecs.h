// The door to OpenImageIO. It brings more than 250 libraries with it, whose symbols take longer to look up than a small
// render takes; so what uses it is a module of its own (io/codecs), which is loaded when a file is first read or
// written that needs it.
#pragma once

#include "io/image.h"
#include "io/image_write.h"
#include "io/texture_cache.h"

namespace etd {

// Tiles of files of write_tiled_levels(), of which those that were used last stay in memory. Any thread may use it.
class TileCache {
 public:
  virtual ~TileCache() = default;
  // As TextureCache has them.
  virtual std::shared_ptr<const CachedImage> open(const std::filesystem::path& path, std::string& error) = 0;
  virtual size_t bytes_in_use() const = 0;
  virtual std::string read_error() const = 0;
  // Returns the texels of a tile, which stay until `tile` is released; null when it can't be read.
  virtual const std::byte* hold(const CachedImage& image, int level, int tile_x, int tile_y, void*& tile) = 0;
  virtual void release(void* tile) = 0;
};

// What the functions of the same names (io/image.h, io/image_write.h, io/texture_cache.h) leave to it when they have
// looked at path and header. What writes returns what went wrong, or an empty string.
class ImageCodecs {
 public:
  virtual ~ImageCodecs() = default;
  virtual ImageResult read_image(const std::filesystem::path& path, const ImageOptions& options) const = 0;
  virtual size_t image_bytes(const std::filesystem::path& path, const std::string& layer) const = 0;
  virtual PartsResult read_parts(const std::filesystem::path& path) const = 0;
  virtual LayersResult read_layers(const std::filesystem::path& path, size_t part, bool with_others) const = 0;
  virtual std::string write_exr(const std::filesystem::path& path, const RowImage& image) const = 0;
  virtual std::string write_8bit(const std::filesystem::path& path, int width, int height, const RowSource& rgb,
                                 float exposure, bool alpha, bool jpeg) const = 0;
  virtual std::string write_hdr(const std::filesystem::path& path, int width, int height,
                                const RowSource& rgb) const = 0;
  virtual std::string write_tiled_levels(const std::filesystem::path& path, const TiledInfo& info,
                                         const std::function<const Image*()>& next) const = 0;
  virtual std::unique_ptr<TileCache> tile_cache(size_t bytes) const = 0;
};

// Loads the module when it is called first, from any thread. Throws std::runtime_error, which says what is missing.
const ImageCodecs& image_codecs();

}  // namespace etd
