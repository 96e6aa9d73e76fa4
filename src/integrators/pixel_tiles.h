// The crop of an image cut into tiles: the work items of integrators that estimate each pixel by itself.
#pragma once

#include <algorithm>

#include "integrators/integrator.h"

namespace etd {

class PixelTiles {
 public:
  explicit PixelTiles(const IntegratorContext& c) : crop_(c.crop), size_(c.tile_size) {}

  size_t count() const { return along(crop_.width()) * along(crop_.height()); }
  PixelBounds tile(size_t item) const {
    const size_t across = along(crop_.width());
    const int x0 = crop_.x0 + static_cast<int>(item % across) * size_;
    const int y0 = crop_.y0 + static_cast<int>(item / across) * size_;
    return {x0, y0, std::min(x0 + size_, crop_.x1), std::min(y0 + size_, crop_.y1)};
  }

 private:
  size_t along(int pixels) const { return static_cast<size_t>((pixels + size_ - 1) / size_); }

  PixelBounds crop_;
  int size_;
};

}  // namespace etd
