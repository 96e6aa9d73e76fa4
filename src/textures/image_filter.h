// How an image is looked up: the filters, over whatever gives out texels. `Texels` has levels(), width(level),
// height(level) and rgba(level, x, y), level 0 being the finest.
#pragma once

#include <array>

#include "core/vec.h"
#include "spectrum/spectrum.h"
#include "textures/wrap.h"

namespace etd {

enum class ImageFilter : uint8_t { kPoint, kBilinear, kTrilinear, kEwa };

// Where: (0, 0) is the upper left corner of the image, (1, 1) the lower right; dx, dy: change over the footprint.
struct ImageLookup {
  Vec2 st, dx, dy;
  ImageFilter filter = ImageFilter::kBilinear;
  ImageWrap wrap = ImageWrap::kRepeat;
  float max_anisotropy = 8;
};

// The weight of a texel in the ellipse by its squared distance from the middle, of 1 at the rim: a Gaussian minus its
// value at the rim (Heckbert 1989, "Fundamentals of Texture Mapping and Image Warping", section 3.5.8).
class EwaWeights {
 public:
  static float at(float r2) {
    static const EwaWeights weights;
    return weights.table_[static_cast<size_t>(r2 * kSize)];
  }

 private:
  static constexpr int kSize = 256;
  EwaWeights() {
    for (int i = 0; i < kSize; ++i)
      table_[static_cast<size_t>(i)] = std::exp(-2.0f * (static_cast<float>(i) + 0.5f) / kSize) - std::exp(-2.0f);
  }
  std::array<float, kSize> table_;
};

// Lanes R, G, B and alpha.
template <class Texels>
class ImageFiltering {
 public:
  ImageFiltering(Texels& texels, const ImageLookup& lookup) : texels_(texels), at_(lookup) {
    // Far outside, whole repetitions are taken off first so that float coordinates keep their precision.
    const auto near = [&](float x) {
      if (at_.wrap == ImageWrap::kRepeat) return x - std::floor(x);
      return at_.wrap == ImageWrap::kOctahedralSphere ? clamp(x, -1.0f, 2.0f) : clamp(x, -64.0f, 65.0f);
    };
    at_.st = {near(at_.st.x), near(at_.st.y)};
  }

  Spectrum value() const {
    if (at_.filter == ImageFilter::kPoint)
      return texel(0, static_cast<int>(std::floor(at_.st.x * width(0))),
                   static_cast<int>(std::floor(at_.st.y * height(0))));
    if (at_.filter == ImageFilter::kTrilinear) return trilinear();
    return at_.filter == ImageFilter::kEwa ? ewa() : bilinear(0);
  }

 private:
  float width(int level) const { return static_cast<float>(texels_.width(level)); }
  float height(int level) const { return static_cast<float>(texels_.height(level)); }

  Spectrum texel(int level, int x, int y) const {
    Spectrum s;
    if (!wrap_texel(x, y, texels_.width(level), texels_.height(level), at_.wrap)) return s;
    const std::array<float, 4> rgba = texels_.rgba(level, x, y);
    for (size_t i = 0; i < 4; ++i) s.v[i] = rgba[i];
    return s;
  }

  Spectrum bilinear(int level) const {
    const float x = at_.st.x * width(level), y = at_.st.y * height(level);
    const float fx = std::floor(x - 0.5f), fy = std::floor(y - 0.5f);
    const int ix = static_cast<int>(fx), iy = static_cast<int>(fy);
    const float dx = x - 0.5f - fx, dy = y - 0.5f - fy;
    return (texel(level, ix, iy) * (1 - dx) + texel(level, ix + 1, iy) * dx) * (1 - dy) +
           (texel(level, ix, iy + 1) * (1 - dx) + texel(level, ix + 1, iy + 1) * dx) * dy;
  }

  // A change in texels of the finest level. What is larger than any image counts as just that.
  Vec2 in_texels(Vec2 d) const {
    constexpr float kMost = 1e9f;
    return {clamp(d.x * width(0), -kMost, kMost), clamp(d.y * height(0), -kMost, kMost)};
  }

  // Interpolates between the two levels on which twice the footprint's larger side is about a texel.
  Spectrum trilinear() const {
    const Vec2 dx = in_texels(at_.dx), dy = in_texels(at_.dy);
    const float side = std::max(std::max(std::abs(dx.x), std::abs(dx.y)), std::max(std::abs(dy.x), std::abs(dy.y)));
    return between_levels(2.0f * side, [&](int level) { return bilinear(level); });
  }

  // Blends `at_level` of the two levels where `size` texels of the finest are one and two texels.
  template <class F>
  Spectrum between_levels(float size, const F& at_level) const {
    const int last = texels_.levels() - 1;
    const float level = size > 1.0f ? std::log2(size) : 0.0f;
    if (!(level < static_cast<float>(last))) return at_level(last);
    const int floor = static_cast<int>(level);
    const float part = level - static_cast<float>(floor);
    if (part == 0.0f) return at_level(floor);
    return at_level(floor) * (1.0f - part) + at_level(floor + 1) * part;
  }

  // Elliptical weighted average (Heckbert 1989): the footprint is an ellipse whose axes are the two changes, the longer
  // at most max_anisotropy times the shorter, on levels where the shorter is one to two texels.
  Spectrum ewa() const {
    Vec2 major = in_texels(at_.dx), minor = in_texels(at_.dy);
    const auto length2 = [](Vec2 v) { return v.x * v.x + v.y * v.y; };
    if (length2(major) < length2(minor)) std::swap(major, minor);
    const float longer = std::sqrt(length2(major));
    float shorter = std::sqrt(length2(minor));
    if (shorter * at_.max_anisotropy < longer) {
      if (!(shorter > 0.0f)) return bilinear(0);
      const float widen = longer / (shorter * at_.max_anisotropy);
      minor = {minor.x * widen, minor.y * widen};
      shorter *= widen;
    }
    // Below a texel the ellipse would only blur what interpolation shows.
    constexpr float kMagnified = 0.5f;
    if (longer <= kMagnified) return bilinear(0);
    const Spectrum mean = between_levels(shorter, [&](int level) { return ellipse(level, major, minor); });
    if (longer >= 2 * kMagnified) return mean;
    const float part = longer / kMagnified - 1.0f;
    return bilinear(0) * (1.0f - part) + mean * part;
  }

  Spectrum ellipse(int level, Vec2 major, Vec2 minor) const {
    if (level == texels_.levels() - 1) return texel(level, 0, 0);
    const float sx = width(level) / width(0), sy = height(level) / height(0);
    const float x0 = at_.st.x * width(level) - 0.5f, y0 = at_.st.y * height(level) - 0.5f;
    const float ax = major.x * sx, ay = major.y * sy, bx = minor.x * sx, by = minor.y * sy;
    // a x^2 + b x y + c y^2 < f inside; the ones widen it by the reconstruction of the image from its texels.
    const float a = ay * ay + by * by + 1, b = -2 * (ax * ay + bx * by), c = ax * ax + bx * bx + 1;
    const float f = sqr(ax * by - bx * ay) + ax * ax + bx * bx + ay * ay + by * by + 1;  // a c - b^2 / 4
    const float half_height = std::sqrt(a);
    Spectrum sum;
    float weights = 0;
    const int y1 = static_cast<int>(std::floor(y0 + half_height));
    for (int y = static_cast<int>(std::ceil(y0 - half_height)); y <= y1; ++y) {
      // The row is inside on both sides of the middle up to half_width.
      const float dy = static_cast<float>(y) - y0, middle = -0.5f * b * dy / a;
      const float half_width = safe_sqrt(f / a * (1.0f - dy * dy / a));
      const int x1 = static_cast<int>(std::floor(x0 + middle + half_width));
      for (int x = static_cast<int>(std::ceil(x0 + middle - half_width)); x <= x1; ++x) {
        const float dx = static_cast<float>(x) - x0;
        const float r2 = (a * dx * dx + b * dx * dy + c * dy * dy) / f;
        if (!(r2 < 1.0f)) continue;
        const float weight = EwaWeights::at(std::max(r2, 0.0f));
        sum += texel(level, x, y) * weight;
        weights += weight;
      }
    }
    return weights > 0.0f ? sum / weights : bilinear(level);
  }

  Texels& texels_;
  ImageLookup at_;
};

template <class Texels>
Spectrum filtered(Texels& texels, const ImageLookup& lookup) {
  return ImageFiltering<Texels>(texels, lookup).value();
}

}  // namespace etd
