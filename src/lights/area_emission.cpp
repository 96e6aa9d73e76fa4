#include "lights/area_emission.h"

#include <algorithm>

namespace etd {

Spectrum AreaEmission::image_value(Vec2 uv) const {
  const int width = image->width(), height = image->height();
  const float x = clamp(uv.x, 0.0f, 1.0f) * static_cast<float>(width) - 0.5f;
  const float y = (1.0f - clamp(uv.y, 0.0f, 1.0f)) * static_cast<float>(height) - 0.5f;
  const float left = std::floor(x), top = std::floor(y), dx = x - left, dy = y - top;
  const auto texel = [&](int i, int j) {
    i = std::clamp(i, 0, width - 1), j = std::clamp(j, 0, height - 1);
    const auto channel = [&](int c) { return std::max(0.0f, image->texel(i, j, image->channels() == 1 ? 0 : c)); };
    return Spectrum::rgb(channel(0), channel(1), channel(2));
  };
  const int i = static_cast<int>(left), j = static_cast<int>(top);
  return (texel(i, j) * (1 - dx) + texel(i + 1, j) * dx) * (1 - dy) +
         (texel(i, j + 1) * (1 - dx) + texel(i + 1, j + 1) * dx) * dy;
}

}  // namespace etd
