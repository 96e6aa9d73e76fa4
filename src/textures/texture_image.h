// An image as textures look it up: levels in memory, or in a file of tiles.
#pragma once

#include <memory>
#include <vector>

#include "io/image.h"
#include "io/texture_cache.h"
#include "textures/image_filter.h"

namespace etd {

class TextureImage {
 public:
  TextureImage() = default;  // of nothing yet
  // The finest level may be shared with other images.
  explicit TextureImage(std::shared_ptr<const Image> finest, std::vector<Image> coarser = {})
      : finest_(std::move(finest)), coarser_(std::move(coarser)) {}
  explicit TextureImage(std::shared_ptr<const CachedImage> cached) : cached_(std::move(cached)) {}

  int channels() const { return cached_ ? cached_->channels() : finest_->channels(); }
  // Lanes R, G, B and alpha.
  Spectrum lookup(const ImageLookup& at) const {
    if (!cached_) return filtered(*this, at);
    CachedTexels texels(*cached_);
    return filtered(texels, at);
  }

  // These levels are in memory, and the finest may be shared.
  const std::shared_ptr<const Image>& finest() const { return finest_; }
  const std::vector<Image>& coarser() const { return coarser_; }

  // What filters read when the levels are in memory.
  int levels() const { return static_cast<int>(coarser_.size()) + 1; }
  int width(int l) const { return level(l).width(); }
  int height(int l) const { return level(l).height(); }
  std::array<float, 4> rgba(int l, int x, int y) const { return level(l).rgba(x, y); }

 private:
  const Image& level(int l) const { return l == 0 ? *finest_ : coarser_[static_cast<size_t>(l) - 1]; }

  std::shared_ptr<const Image> finest_;
  std::vector<Image> coarser_;
  std::shared_ptr<const CachedImage> cached_;
};

}  // namespace etd
