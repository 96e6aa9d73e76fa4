// Perlin's gradient noise and the sums of it that solid textures are made of.
#pragma once

#include "core/vec.h"

namespace etd {

// Noise of unit frequency: 0 at integer points, smooth between them, within [-1, 1] (Perlin 2002, "Improving Noise",
// with its permutation; the last four of the sixteen gradients are those of pbrt-v4).
float noise(Point3 p);

// How many octaves are summed: `octaves`, or fewer where the footprint is too large for the finest. Each has 1.99 times
// the frequency of the one before and `roughness` times its size.
struct NoiseSum {
  int octaves = 8;         // at most
  float roughness = 0.5f;  // amplitude of an octave relative to the one before
};

// Fractional Brownian motion: the sum of noise. dx, dy: change of p over the footprint.
float fbm(Point3 p, Vec3 dx, Vec3 dy, const NoiseSum& sum);
// The sum of the noise's absolute values; octaves that are too fine count with their mean, 0.2.
float turbulence(Point3 p, Vec3 dx, Vec3 dy, const NoiseSum& sum);

}  // namespace etd
