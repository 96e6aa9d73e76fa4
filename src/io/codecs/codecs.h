// The module of io/image_codecs.h. It is no part of the library, whose functions it finds in the program that loads it.
#pragma once

#include "io/image_codecs.h"

namespace etd {

class OiioCodecs : public ImageCodecs {
 public:
  // read.cpp
  ImageResult read_image(const std::filesystem::path& path, const ImageOptions& options) const override;
  size_t image_bytes(const std::filesystem::path& path, const std::string& layer) const override;
  // layers.cpp
  PartsResult read_parts(const std::filesystem::path& path) const override;
  LayersResult read_layers(const std::filesystem::path& path, size_t part, bool with_others) const override;
  // write.cpp
  std::string write_exr(const std::filesystem::path& path, const RowImage& image) const override;
  std::string write_8bit(const std::filesystem::path& path, int width, int height, const RowSource& rgb, float exposure,
                         bool alpha, bool jpeg) const override;
  std::string write_hdr(const std::filesystem::path& path, int width, int height, const RowSource& rgb) const override;
  // tiles.cpp
  std::string write_tiled_levels(const std::filesystem::path& path, const TiledInfo& info,
                                 const std::function<const Image*()>& next) const override;
  std::unique_ptr<TileCache> tile_cache(size_t bytes) const override;
};

}  // namespace etd
