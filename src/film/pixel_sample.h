// What one sample of one pixel contributes, and the running sums of many: the currency between integrators and film.
#pragma once

#include <array>

#include "core/vec.h"
#include "film/pixel_ids.h"
#include "spectrum/spectrum.h"

namespace etd {

// Rays traced, by what they were for.
struct RayCounts {
  uint64_t camera = 0, indirect = 0, shadow = 0;
  uint64_t total() const { return camera + indirect + shadow; }
  RayCounts& operator+=(const RayCounts& b) {
    camera += b.camera, indirect += b.indirect, shadow += b.shadow;
    return *this;
  }
};

// Radiance split by path depth (0: emission, 1: direct, 2 and more: indirect), already divided by the sample's density;
// features at the first non-delta vertex (zero on a miss).
struct PixelSample {
  float weight = 1;  // of the pixel filter, on everything; may be negative
  Spectrum emission, direct, indirect;
  Spectrum albedo;
  Vec3 normal;          // shading normal in world space on the viewer's side
  Vec3 position;        // of that vertex, in the recentred world
  float depth = 0;      // path length to it, in metres
  float coverage = 0;   // 1 when such a vertex exists
  float alpha = 0;      // 1 when the camera ray met a surface
  SurfaceIds ids;       // of that surface
  float distance2 = 0;  // of the place on the film from the centre of the pixel, in pixels, squared
  RayCounts rays;
};

// Sums over samples of one pixel, in one replicate or over several.
struct PixelSums {
  std::array<double, 3> emission{}, direct{}, indirect{};
  std::array<double, 4> squares{};  // of the samples' total R, G, B and luminance Y
  std::array<double, 3> albedo{}, normal{}, position{};
  double depth = 0, coverage = 0;
  std::array<double, 3> albedo_squares{}, normal_squares{};  // and so on: sums of the squares of what samples add
  double depth_squares = 0, coverage_squares = 0;
  std::array<double, 3> surface_emission{};  // the part of the emission that surfaces emit, not what is behind them all
  double alpha = 0;
  double count = 0, rays = 0;

  // Returns the luminance of the sample as it was added: with the weight.
  double add(const PixelSample& s);
  PixelSums& operator+=(const PixelSums& b);

  // Means over the samples; zero where none was taken.
  std::array<double, 3> mean(const std::array<double, 3>& sum) const;
  // Mean of the samples' total R, G, B and luminance Y.
  std::array<double, 4> mean_radiance() const;
};

}  // namespace etd
