#include "textures/noise.h"

#include <array>

namespace etd {

namespace {

// The reference permutation of Perlin 2002.
constexpr std::array<uint8_t, 256> kPermutation = {
    151, 160, 137, 91,  90,  15,  131, 13,  201, 95,  96,  53,  194, 233, 7,   225, 140, 36,  103, 30,  69,  142,
    8,   99,  37,  240, 21,  10,  23,  190, 6,   148, 247, 120, 234, 75,  0,   26,  197, 62,  94,  252, 219, 203,
    117, 35,  11,  32,  57,  177, 33,  88,  237, 149, 56,  87,  174, 20,  125, 136, 171, 168, 68,  175, 74,  165,
    71,  134, 139, 48,  27,  166, 77,  146, 158, 231, 83,  111, 229, 122, 60,  211, 133, 230, 220, 105, 92,  41,
    55,  46,  245, 40,  244, 102, 143, 54,  65,  25,  63,  161, 1,   216, 80,  73,  209, 76,  132, 187, 208, 89,
    18,  169, 200, 196, 135, 130, 116, 188, 159, 86,  164, 100, 109, 198, 173, 186, 3,   64,  52,  217, 226, 250,
    124, 123, 5,   202, 38,  147, 118, 126, 255, 82,  85,  212, 207, 206, 59,  227, 47,  16,  58,  17,  182, 189,
    28,  42,  223, 183, 170, 213, 119, 248, 152, 2,   44,  154, 163, 70,  221, 153, 101, 155, 167, 43,  172, 9,
    129, 22,  39,  253, 19,  98,  108, 110, 79,  113, 224, 232, 178, 185, 112, 104, 218, 246, 97,  228, 251, 34,
    242, 193, 238, 210, 144, 12,  191, 179, 162, 241, 81,  51,  145, 235, 249, 14,  239, 107, 49,  192, 214, 31,
    181, 199, 106, 157, 184, 84,  204, 176, 115, 121, 50,  45,  127, 4,   150, 254, 138, 236, 205, 93,  222, 114,
    67,  29,  24,  72,  243, 141, 128, 195, 78,  66,  215, 61,  156, 180};

// The middles of the edges of a cube; four of them twice.
constexpr std::array<std::array<int8_t, 3>, 16> kGradients = {{{1, 1, 0},
                                                               {-1, 1, 0},
                                                               {1, -1, 0},
                                                               {-1, -1, 0},
                                                               {1, 0, 1},
                                                               {-1, 0, 1},
                                                               {1, 0, -1},
                                                               {-1, 0, -1},
                                                               {0, 1, 1},
                                                               {0, -1, 1},
                                                               {0, 1, -1},
                                                               {0, -1, -1},
                                                               {1, 1, 0},
                                                               {-1, 1, 0},
                                                               {0, 1, -1},
                                                               {0, -1, -1}}};

uint8_t permuted(int i) { return kPermutation[static_cast<size_t>(i & 255)]; }

// The product of a corner's gradient and the way from the corner.
float ramp(int x, int y, int z, Vec3 d) {
  const auto& g = kGradients[permuted(permuted(permuted(x) + y) + z) & 15u];
  return static_cast<float>(g[0]) * d.x + static_cast<float>(g[1]) * d.y + static_cast<float>(g[2]) * d.z;
}

// A coordinate as cell and place within it. The pattern repeats every 256 cells; far out, where floats are sparse, what
// is left of it repeats too.
struct Cell {
  int index;
  float offset, weight;  // weight of the upper corner: 6 t^5 - 15 t^4 + 10 t^3

  explicit Cell(float x) {
    const float near = std::isfinite(x) ? std::fmod(x, 0x1p30f) : 0.0f, floor = std::floor(near);
    index = static_cast<int>(floor);
    offset = near - floor;
    weight = offset * offset * offset * (10 + offset * (6 * offset - 15));
  }
};

// The number of octaves whose period, relative to the footprint, is above two: with each, the frequency doubles.
float octaves_that_fit(Vec3 dx, Vec3 dy, int most) {
  const float size2 = std::max(dot(dx, dx), dot(dy, dy));
  return clamp(-1.0f - 0.5f * std::log2(size2), 0.0f, static_cast<float>(most));
}

// 0 up to 0.3, 1 from 0.7 on, smooth between.
float fade_in(float part) {
  const float t = clamp((part - 0.3f) / 0.4f, 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

constexpr float kLacunarity = 1.99f;  // not 2: zeros of octaves would fall on each other

}  // namespace

float noise(Point3 p) {
  const Cell x(p.x), y(p.y), z(p.z);
  const auto at = [&](int i, int j, int k) {
    return ramp(x.index + i, y.index + j, z.index + k,
                {x.offset - static_cast<float>(i), y.offset - static_cast<float>(j), z.offset - static_cast<float>(k)});
  };
  const auto along_x = [&](int j, int k) { return lerp(x.weight, at(0, j, k), at(1, j, k)); };
  const auto along_y = [&](int k) { return lerp(y.weight, along_x(0, k), along_x(1, k)); };
  return lerp(z.weight, along_y(0), along_y(1));
}

float fbm(Point3 p, Vec3 dx, Vec3 dy, const NoiseSum& s) {
  const float n = octaves_that_fit(dx, dy, s.octaves);
  const int whole = static_cast<int>(n);
  float sum = 0, frequency = 1, amplitude = 1;
  const auto octave = [&] { return noise(Point3{} + (p - Point3{}) * frequency); };
  for (int i = 0; i < whole; ++i, frequency *= kLacunarity, amplitude *= s.roughness) sum += amplitude * octave();
  return whole == s.octaves ? sum : sum + amplitude * fade_in(n - static_cast<float>(whole)) * octave();
}

float turbulence(Point3 p, Vec3 dx, Vec3 dy, const NoiseSum& s) {
  constexpr float kMean = 0.2f;
  const float n = octaves_that_fit(dx, dy, s.octaves);
  const int whole = static_cast<int>(n);
  float sum = 0, frequency = 1, amplitude = 1;
  const auto octave = [&] { return std::abs(noise(Point3{} + (p - Point3{}) * frequency)); };
  for (int i = 0; i < whole; ++i, frequency *= kLacunarity, amplitude *= s.roughness) sum += amplitude * octave();
  if (whole == s.octaves) return sum + amplitude * kMean;
  sum += amplitude * lerp(fade_in(n - static_cast<float>(whole)), kMean, octave());
  for (int i = whole; i < s.octaves; ++i, amplitude *= s.roughness) sum += amplitude * kMean;
  return sum;
}

}  // namespace etd
