// Procedural textures and mappings against a second, plain evaluation of their definitions: noise is written here as
// its sum over the eight corners of a cell, in double, from the published permutation.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <vector>

#include "core/hash.h"
#include "texture_table.h"
#include "textures/mapping.h"

namespace etd {
namespace {

// The first and the last entries of Perlin's table; the whole is checked by its sum of products below.
const std::vector<int>& permutation() {
  static const std::vector<int> p = {
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
  return p;
}

double plain_noise(double x, double y, double z) {
  const auto perm = [](long i) { return permutation()[static_cast<size_t>(((i % 256) + 256) % 256)]; };
  const auto quintic = [](double t) { return 6 * std::pow(t, 5) - 15 * std::pow(t, 4) + 10 * std::pow(t, 3); };
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const double at[3] = {x, y, z};
    double weight = 1, d[3];
    long cell[3];
    for (int axis = 0; axis < 3; ++axis) {
      const int up = corner >> axis & 1;
      const double t = at[axis] - std::floor(at[axis]);
      weight *= up ? quintic(t) : 1 - quintic(t);
      d[axis] = t - up;
      cell[axis] = std::lround(std::floor(at[axis])) + up;
    }
    // The gradient by bits of the hash: two of the three offsets, each with a sign.
    const int h = perm(perm(perm(cell[0]) + cell[1]) + cell[2]) & 15;
    const bool pair_xy = h < 4 || h == 12 || h == 13, has_x = pair_xy || h < 8;
    const double u = has_x ? d[0] : d[1], v = pair_xy ? d[1] : d[2];
    sum += weight * ((h & 1 ? -u : u) + (h & 2 ? -v : v));
  }
  return sum;
}

double plain_fbm(Point3d p, int octaves, double roughness, bool absolute = false) {
  double sum = 0;
  for (int i = 0; i < octaves; ++i) {
    const double f = std::pow(1.99, i), n = plain_noise(f * p.x, f * p.y, f * p.z);
    sum += std::pow(roughness, i) * (absolute ? std::abs(n) : n);
  }
  return sum;
}

// Points in [-size, size]^3, the same in each run.
std::vector<Point3> points(size_t count, float size) {
  HashStream rng(11);
  std::vector<Point3> all;
  const auto next = [&] { return size * (2 * rng.next_float() - 1); };
  for (size_t i = 0; i < count; ++i) {
    const float x = next(), y = next(), z = next();
    all.push_back({x, y, z});
  }
  return all;
}

void expect_everywhere(const Textures& t, const SpectrumSource& s, const std::function<double(Point3d)>& expected,
                       double tolerance, float size = 20) {
  double worst = 0;
  for (const Point3& p : points(500, size))
    worst = std::max(worst, std::abs(double(t.at(s, p)[0]) - expected(to_double(p))));
  EXPECT_LT(worst, tolerance);
}

TEST(Noise, PermutationIsOne) {
  std::array<int, 256> seen{};
  for (const int i : permutation()) ++seen[static_cast<size_t>(i)];
  for (const int count : seen) EXPECT_EQ(count, 1);
}

TEST(Noise, FbmIsTheSumOfItsOctaves) {
  Textures t;
  const auto integer = [](const char* name, int32_t value) {
    Param p;
    p.name = name;
    p.kind = ParamKind::kInteger;
    p.integers = {value};
    return p;
  };
  const SpectrumSource one = t.add("1", use_of("fbm", {integer("octaves", 1)}), true);
  expect_everywhere(
      t, one, [](Point3d p) { return plain_noise(p.x, p.y, p.z); }, 2e-5);
  const SpectrumSource some = t.add("f", use_of("fbm", {integer("octaves", 5), number("roughness", 0.7)}), true);
  expect_everywhere(
      t, some, [](Point3d p) { return plain_fbm(p, 5, 0.7); }, 2e-4);
  const SpectrumSource plain = t.add("p", use_of("fbm"), true);
  expect_everywhere(
      t, plain, [](Point3d p) { return plain_fbm(p, 8, 0.5); }, 3e-4);
  const SpectrumSource none = t.add("0", use_of("fbm", {integer("octaves", 0)}), true);
  expect_everywhere(
      t, none, [](Point3d) { return 0.0; }, 1e-9);
  const SpectrumSource wrinkled = t.add("w", use_of("wrinkled", {integer("octaves", 4)}), true);
  expect_everywhere(
      t, wrinkled, [](Point3d p) { return plain_fbm(p, 4, 0.5, true) + 0.2 / 16; }, 2e-4);
  const SpectrumSource windy = t.add("y", use_of("windy"), true);
  expect_everywhere(
      t, windy,
      [](Point3d p) {
        return std::abs(plain_fbm({0.1 * p.x, 0.1 * p.y, 0.1 * p.z}, 3, 0.5)) * plain_fbm(p, 6, 0.5);
      },
      3e-4);
  ASSERT_FALSE(t.diagnostics.has_errors()) << t.diagnostics.format_all();
}

TEST(Noise, WildPlacesGiveNumbers) {
  Textures t;
  std::vector<SpectrumSource> all;
  for (const char* model : {"fbm", "wrinkled", "windy"}) all.push_back(t.add(model, use_of(model), true));
  all.push_back(t.add("m", use_of("marble", {number("scale", 1e30), number("variation", 1e30)})));
  for (const char* mapping : {"spherical", "cylindrical", "planar"})
    for (const char* model : {"dots", "bilerp", "checkerboard"})
      all.push_back(t.add(std::string(model) + mapping, use_of(model, {text("mapping", mapping)})));
  const float wild[] = {0, -1e-40f, 1, 1e9f, -1e18f, 3e38f, kInfinity, std::numeric_limits<float>::quiet_NaN()};
  for (const SpectrumSource& s : all)
    for (const float x : wild)
      for (const float y : wild)
        for (const float z : wild) {
          TexCoord at{{x, y}, {x, y, z}, {0, 0, 1}, {x, z, y}, {z, z, x}, {x, z}, {y, x}};
          EXPECT_TRUE(is_finite(t.table.eval(s, at, {}))) << s.texture << ' ' << x << ' ' << y << ' ' << z;
        }
}

// Where the footprint is as large as the period of an octave, the octave is gone; what is left is within the mean over
// the footprint to the size of what was taken away.
TEST(Noise, OctavesFadeWithTheFootprint) {
  Textures t;
  const SpectrumSource fbm = t.add("f", use_of("fbm"), true), wrinkled = t.add("w", use_of("wrinkled"), true);
  const auto with = [&](const SpectrumSource& s, Point3 p, float size) {
    return double(t.table.eval(s, {{}, p, {}, {size, 0, 0}, {0, 0.5f * size, 0}}, {})[0]);
  };
  double square = 0, square_plain = 0, mean_wrinkled = 0;
  for (const Point3& p : points(300, 20)) {
    EXPECT_EQ(with(fbm, p, 1e-9f), double(t.at(fbm, p)[0]));
    EXPECT_NEAR(with(fbm, p, 1.0f / 16), plain_fbm(to_double(p), 3, 0.5), 1e-4);  // -1 + log2(16) octaves
    EXPECT_EQ(with(fbm, p, 1.0f), 0.0);
    square += sqr(with(fbm, p, 1.0f / 32) - plain_fbm(to_double(p), 8, 0.5));
    square_plain += sqr(plain_fbm(to_double(p), 8, 0.5));
    mean_wrinkled += with(wrinkled, p, 1.0f / 8) - with(wrinkled, p, 0.0f);
  }
  EXPECT_LT(square, 0.02 * square_plain);
  EXPECT_NEAR(mean_wrinkled / 300, 0.0, 0.1);
}

TEST(Marble, ColoursByHeight) {
  Textures t;
  const SpectrumSource flat = t.add("m", use_of("marble", {number("variation", 0), number("scale", 2)}));
  // t = 0, 1/2 and 1: the ends of the first, third and sixth curve.
  const auto at_phase = [&](double phase) { return t.at(flat, Point3{3, static_cast<float>(phase / 2), 5}); };
  EXPECT_NEAR(at_phase(-kPiD / 2)[2], 1.5 * 0.6, 1e-5);
  EXPECT_NEAR(at_phase(0)[0], 1.5 * 0.5, 1e-5);
  EXPECT_NEAR(at_phase(kPiD / 2)[0], 1.5 * 0.58, 1e-4);
  // The middle of the last curve, between the dark vein and its neighbours.
  const double phase = std::asin(2 * 5.5 / 6 - 1);
  EXPECT_NEAR(at_phase(phase)[0], 1.5 * (0.58 + 3 * 0.58 + 3 * 0.2 + 0.58) / 8, 1e-3);
  EXPECT_NEAR(at_phase(phase)[2], 1.5 * (0.6 + 3 * 0.6 + 3 * 0.33 + 0.6) / 8, 1e-3);
  const SpectrumSource bent = t.add("b", use_of("marble", {number("variation", 3)}));
  for (const Point3& p : points(100, 5)) {
    const double y = double(p.y) + 3 * plain_fbm(to_double(p), 8, 0.5);
    EXPECT_NEAR(t.at(bent, p)[0], t.at(flat, Point3{0, static_cast<float>(y / 2), 0})[0], 2e-3);
  }
}

TEST(Dots, AreWhereNoisePutsThem) {
  Textures t;
  const SpectrumSource dots = t.add("d", use_of("dots", {rgb("inside", 0, 0.25, 1), number("outside", 0.75)}));
  int inside = 0;
  for (const Point3& p : points(2000, 30)) {
    const double s = std::floor(p.x + 0.5), c = std::floor(p.y + 0.5);
    const double ds = p.x - s - 0.15 * plain_noise(s + 1.5, c + 2.8, 0.5);
    const double dt = p.y - c - 0.15 * plain_noise(s + 4.5, c + 9.8, 0.5);
    const double r = std::sqrt(ds * ds + dt * dt);
    if (std::abs(r - 0.35) < 1e-4) continue;
    const bool in = plain_noise(s + 0.5, c + 0.5, 0.5) > 0 && r < 0.35;
    inside += in;
    EXPECT_EQ(t.at(dots, p.x, p.y)[1], in ? 0.25f : 0.75f);
  }
  EXPECT_GT(inside, 200);
}

TEST(Bilerp, InsideAndBeyondItsCorners) {
  Textures t;
  const SpectrumSource b = t.add("b", use_of("bilerp", {number("v00", 1), number("v01", 2), number("v10", 4),
                                                        rgb("v11", 8, 0, 3), number("uscale", 2)}));
  EXPECT_EQ(t.at(b, 0, 0)[0], 1.0f);
  EXPECT_EQ(t.at(b, 0, 1)[0], 2.0f);
  EXPECT_EQ(t.at(b, 0.5f, 0)[0], 4.0f);
  EXPECT_EQ(t.at(b, 0.5f, 1)[2], 3.0f);
  EXPECT_NEAR(t.at(b, 0.125f, 0.75f)[0], 0.75 * (0.25 * 1 + 0.75 * 2) + 0.25 * (0.25 * 4 + 0.75 * 8), 1e-6);
  EXPECT_NEAR(t.at(b, 1.0f, 0)[1], 7.0, 1e-6);
  const SpectrumSource plain = t.add("p", use_of("bilerp"));
  EXPECT_NEAR(t.at(plain, 0.3f, 0.6f)[0], 0.6, 1e-6);
}

TEST(Mixes, ByAmountAndByDirection) {
  Textures t;
  t.add("a", use_of("bilerp"), true);
  const SpectrumSource mix =
      t.add("m", use_of("mix", {rgb("tex1", 1, 0, 0), rgb("tex2", 0, 0, 1), texture("amount", "a")}));
  EXPECT_NEAR(t.at(mix, 0, 0.25f)[0], 0.75, 1e-6);
  EXPECT_NEAR(t.at(mix, 0, 0.25f)[2], 0.25, 1e-6);
  EXPECT_EQ(t.at(mix, 0, 1)[0], 0.0f);
  EXPECT_EQ(t.at(t.add("h", use_of("mix")), 0, 0)[0], 0.5f);
  // The direction turns with the transform: here dir is the world's x.
  const SpectrumSource d = t.add("d",
                                 use_of("directionmix", {rgb("tex1", 1, 0, 0), rgb("tex2", 0, 0, 1),
                                                         numbers("dir", ParamKind::kVector3, {0, 7, 0})}),
                                 false, Transform::rotate(-90, {0, 0, 1}));
  ASSERT_FALSE(t.diagnostics.has_errors()) << t.diagnostics.format_all();
  for (const float sign : {1.0f, -1.0f}) {
    const Spectrum v = t.table.eval(d, {{}, {}, {0.6f * sign, 0.8f, 0}}, {});
    EXPECT_NEAR(v[0], 0.6, 1e-6);
    EXPECT_NEAR(v[2], 0.4, 1e-6);
  }
}

// The space of a texture: rotated, scaled, moved, under a recentred world.
TEST(Mapping, CoordinatesInTheSpaceOfTheTexture) {
  Textures t;
  const Transform space =
      Transform::translate({5, 6, 7}) * Transform::rotate(40, {1, 2, 3}) * Transform::scale({2, 0.5, 1.5});
  // A bilerp of the corners 0, 0, 1, 1 is s; of 0, 1, 0, 1 it is t.
  const auto coordinate = [&](const char* mapping, bool s, std::vector<Param> more = {}) {
    more.push_back(text("mapping", mapping));
    if (s) more.insert(more.end(), {number("v01", 0), number("v10", 1)});
    return t.add(std::string(mapping) + (s ? "s" : "t"), use_of("bilerp", more), false, space);
  };
  const std::vector<Param> plane = {numbers("v1", ParamKind::kVector3, {1, 2, 3}),
                                    numbers("v2", ParamKind::kVector3, {0, -1, 0.5}), number("udelta", 0.25),
                                    number("vdelta", -3)};
  const SpectrumSource sphere_s = coordinate("spherical", true), sphere_t = coordinate("spherical", false),
                       tube_s = coordinate("cylindrical", true), tube_t = coordinate("cylindrical", false),
                       plane_s = coordinate("planar", true, plane), plane_t = coordinate("planar", false, plane);
  ASSERT_EQ(t.diagnostics.all().size(), 0u) << t.diagnostics.format_all();
  t.recentre({100, 200, -300});
  for (const Point3& p : points(200, 3)) {
    const Point3d w = space.point(to_double(p));
    const Point3 at = to_float(Point3d{w.x - 100, w.y - 200, w.z + 300});
    const double x = p.x, y = p.y, z = p.z, phi = std::atan2(y, x);
    EXPECT_NEAR(t.at(sphere_s, at)[0], std::acos(z / std::sqrt(x * x + y * y + z * z)) / kPiD, 1e-3);
    EXPECT_NEAR(t.at(sphere_t, at)[0], phi / (2 * kPiD) + (phi < 0), 2e-3);
    EXPECT_NEAR(t.at(tube_s, at)[0], phi / (2 * kPiD) + 0.5, 2e-3);
    EXPECT_NEAR(t.at(tube_t, at)[0], z, 2e-4);
    EXPECT_NEAR(t.at(plane_s, at)[0], x + 2 * y + 3 * z + 0.25, 1e-3);
    EXPECT_NEAR(t.at(plane_t, at)[0], -y + 0.5 * z - 3, 1e-3);
  }
}

// The changes of the coordinates are their differences over a small footprint.
TEST(Mapping, ChangesAreDifferences) {
  TextureTable table;
  table.spaces.emplace_back(Transform::rotate(20, {3, 1, 2}).matrix());
  const float step = 1e-3f;
  for (const auto kind : {Mapping2::Kind::kSpherical, Mapping2::Kind::kCylindrical, Mapping2::Kind::kPlanar}) {
    Mapping2 m;
    m.kind = kind;
    m.space = 0;
    m.v1 = {1, 2, 3};
    for (const Point3& p : points(50, 2)) {
      const Vec3 dx = Vec3{0.5f, 1, -1} * step, dy = Vec3{-1, 0.2f, 0.7f} * step;
      const MappedPoint2 at = m({{}, p, {}, dx, dy}, table);
      const auto expect_change = [&](Vec3 d, Vec2 change) {
        const Vec2 up = m({{}, p + d * 0.5f}, table).st, down = m({{}, p - d * 0.5f}, table).st;
        if (std::abs(up.x - down.x) > 0.4f || std::abs(up.y - down.y) > 0.4f) return;  // across the seam
        EXPECT_NEAR(change.x, up.x - down.x, 2e-5f + 0.02f * std::abs(change.x));
        EXPECT_NEAR(change.y, up.y - down.y, 2e-5f + 0.02f * std::abs(change.y));
      };
      expect_change(dx, at.dx);
      expect_change(dy, at.dy);
    }
  }
}

TEST(Checkerboard, CubesInTextureSpace) {
  Textures t;
  Param dimension;
  dimension.name = "dimension";
  dimension.kind = ParamKind::kInteger;
  dimension.integers = {3};
  const SpectrumSource cubes = t.add("c", use_of("checkerboard", {dimension}), false, Transform::scale({0.5, 1, 2}));
  ASSERT_EQ(t.diagnostics.all().size(), 0u) << t.diagnostics.format_all();
  for (const Point3& p : points(500, 9)) {
    const auto cell = [](double x) { return static_cast<int>(std::floor(x)); };
    const int sum = cell(p.x / 0.5) + cell(p.y) + cell(p.z / 2);
    EXPECT_EQ(t.at(cubes, p)[0], sum % 2 == 0 ? 1.0f : 0.0f);
  }
}

// What is filtered is the mean of what is not, weighted with a product of triangles.
TEST(Checkerboard, FilteredOverTheFootprint) {
  Textures t;
  const SpectrumSource board = t.add("c", use_of("checkerboard"));
  HashStream rng(5);
  for (int i = 0; i < 60; ++i) {
    const float u = 8 * rng.next_float() - 4, v = 8 * rng.next_float() - 4;
    const float du = 2 * sqr(rng.next_float()), dv = 2 * sqr(rng.next_float());
    const double r[2] = {1.5 * double(du), 1.5 * double(dv)};
    double sum = 0;
    constexpr int kCells = 200;
    for (int a = 0; a < kCells; ++a)
      for (int b = 0; b < kCells; ++b) {
        const double x = (a + 0.5) / kCells * 2 - 1, y = (b + 0.5) / kCells * 2 - 1;
        const double cells = std::floor(double(u) + x * r[0]) + std::floor(double(v) + y * r[1]);
        if (std::fmod(cells, 2.0) == 0.0) sum += (1 - std::abs(x)) * (1 - std::abs(y));
      }
    const double mean = sum * 4 / (kCells * kCells);
    EXPECT_NEAR(t.table.eval(board, {{u, v}, {}, {}, {}, {}, {du, 0}, {0.3f * du, dv}}, {})[0], mean, 0.012)
        << u << ' ' << v << ' ' << du << ' ' << dv;
  }
}

}  // namespace
}  // namespace etd
