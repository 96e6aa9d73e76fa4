// What lies outside the unit square of an image.
#pragma once

#include <algorithm>
#include <cstdint>

namespace etd {

enum class ImageWrap : uint8_t { kRepeat, kBlack, kClamp, kOctahedralSphere };

// The index that i of n stands for; -1: black.
inline int wrap_index(int i, int n, ImageWrap wrap) {
  if (i >= 0 && i < n) return i;
  if (wrap == ImageWrap::kBlack) return -1;
  if (wrap == ImageWrap::kClamp) return i < 0 ? 0 : n - 1;
  return (i % n + n) % n;
}

// Moves a texel's indices to those of the texel that it stands for; false: black.
inline bool wrap_texel(int& x, int& y, int w, int h, ImageWrap wrap) {
  if (wrap != ImageWrap::kOctahedralSphere) {
    x = wrap_index(x, w, wrap);
    y = wrap_index(y, h, wrap);
    return x >= 0 && y >= 0;
  }
  // Beyond an edge of an octahedral map lies the same edge, walked backwards.
  if (x < 0 || x >= w) {
    x = x < 0 ? -x - 1 : 2 * w - 1 - x;
    y = h - 1 - y;
  }
  if (y < 0 || y >= h) {
    y = y < 0 ? -y - 1 : 2 * h - 1 - y;
    x = w - 1 - x;
  }
  x = std::clamp(x, 0, w - 1);
  y = std::clamp(y, 0, h - 1);
  return true;
}

}  // namespace etd
