// Images that need not fit into memory: files of tiles, of which OpenImageIO's cache keeps those read last.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "io/image.h"

namespace etd {

// What a file of tiles says about the image that it was made from.
struct TiledInfo {
  ImageEncoding encoding;          // of bytes
  std::vector<std::string> notes;  // of reading it
};

// Writes an image and its coarser levels, finest first, as a file of tiles that TextureCache reads: each level as it is
// stored in memory. `next` gives one level after the other, and null at the end. The file appears when it is complete.
// Returns what went wrong, or an empty string.
std::string write_tiled_levels(const std::filesystem::path& path, const TiledInfo& info,
                               const std::function<const Image*()>& next);

class CachedImage;
class TileCache;  // io/image_codecs.h

class TextureCache {
 public:
  // Keeps at most about `bytes` of tiles in memory.
  explicit TextureCache(size_t bytes);
  ~TextureCache();
  TextureCache(const TextureCache&) = delete;
  TextureCache& operator=(const TextureCache&) = delete;

  // A file of write_tiled_levels(); null and a reason if it is none.
  std::shared_ptr<const CachedImage> open(const std::filesystem::path& path, std::string& error);
  // Counts the bytes of the tiles that are in memory now.
  size_t bytes_in_use() const;
  // What went wrong first when tiles were read, which were then taken as black; empty: nothing.
  std::string read_error() const;

 private:
  std::unique_ptr<TileCache> tiles_;
};

// An open file of tiles. Its cache outlives it.
class CachedImage {
 public:
  int levels() const { return static_cast<int>(levels_.size()); }
  int width(int level) const { return levels_[static_cast<size_t>(level)].width; }
  int height(int level) const { return levels_[static_cast<size_t>(level)].height; }
  int channels() const { return channels_; }
  const TiledInfo& info() const { return info_; }

 private:
  friend class OiioTiles;
  friend class CachedTexels;
  struct Level {
    int width, height;
    TexelFormat format;
  };
  TileCache* tiles_ = nullptr;
  void* handle_ = nullptr;  // of the file in OpenImageIO's cache
  int channels_ = 1;
  TiledInfo info_;
  std::vector<Level> levels_;
};

// Reads texels of one image, and keeps hold of the tile that it read last. Of one thread, for one lookup.
class CachedTexels {
 public:
  explicit CachedTexels(const CachedImage& image) : image_(image) {}
  ~CachedTexels() { release(); }
  CachedTexels(const CachedTexels&) = delete;
  CachedTexels& operator=(const CachedTexels&) = delete;

  int levels() const { return image_.levels(); }
  int width(int level) const { return image_.width(level); }
  int height(int level) const { return image_.height(level); }
  std::array<float, 4> rgba(int level, int x, int y) {
    if (level != level_ || x / kTile != tile_x_ || y / kTile != tile_y_) fetch(level, x / kTile, y / kTile);
    if (texels_ == nullptr) return {0, 0, 0, 0};
    const auto index = static_cast<size_t>(y % kTile * kTile + x % kTile);
    return image_.levels_[static_cast<size_t>(level)].format.rgba(texels_, index, image_.channels_);
  }

  static constexpr int kTile = 64;  // texels along each side

 private:
  void fetch(int level, int tile_x, int tile_y);
  void release();

  const CachedImage& image_;
  int level_ = -1, tile_x_ = -1, tile_y_ = -1;
  void* tile_ = nullptr;
  const std::byte* texels_ = nullptr;
};

}  // namespace etd
