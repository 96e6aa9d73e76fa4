// Polygons of every shape, place and size as triangles, against their area: the triangles cover a polygon exactly when
// all have its orientation and their areas add up to its own.
#include "io/polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include <fmt/format.h>

#include "core/hash.h"

namespace etd {
namespace {

using Flat = std::vector<std::array<double, 2>>;
using Triangles = std::vector<std::array<uint32_t, 3>>;

double turn(const std::array<double, 2>& a, const std::array<double, 2>& b, const std::array<double, 2>& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// Twice the area, positive counterclockwise.
double area_of(const Flat& p) {
  double sum = 0;
  for (size_t i = 2; i < p.size(); ++i) sum += turn(p[0], p[i - 1], p[i]);
  return sum;
}

// Says where the corners of a flat polygon are put in space.
struct Place {
  Vec3d u{1, 0, 0}, v{0, 1, 0}, at{0, 0, 0};
  Point3d point(const std::array<double, 2>& p) const { return Point3d() + (at + u * p[0] + v * p[1]); }
};

Place random_place(HashStream& random) {
  const auto uniform = [&] { return 2 * static_cast<double>(random.next_float()) - 1; };
  Place place;
  const Vec3d n = normalize(Vec3d{uniform(), uniform(), uniform()});
  place.u = normalize(cross(n, Vec3d{0.3, -0.5, 0.9}));
  place.v = cross(n, place.u);
  const double scale = std::pow(10.0, 30 * uniform());
  place.u = place.u * scale, place.v = place.v * scale;
  place.at = Vec3d{uniform(), uniform(), uniform()} * scale;
  return place;
}

struct Cut {
  Triangles triangles;
  bool simple;
};

Cut cut(const Flat& flat, const Place& place = {}) {
  static PolygonCutter cutter;        // it must forget the polygon before
  std::vector<Point3d> positions(1);  // an offset, so that corners are told from positions
  std::vector<uint32_t> corners;
  for (const auto& p : flat) {
    corners.push_back(static_cast<uint32_t>(positions.size()));
    positions.push_back(place.point(p));
  }
  Cut result;
  result.simple = cutter.cut(positions, corners, result.triangles);
  for (auto& t : result.triangles)
    for (uint32_t& c : t) --c;
  return result;
}

// Measures the triangles in the polygon's own plane, so that the place does not matter.
void expect_covers(const Flat& flat, const Cut& result, const std::string& what) {
  const double area = area_of(flat), sign = area < 0 ? -1 : 1;
  double sum = 0, most_negative = 0;
  for (const auto& t : result.triangles) {
    for (const uint32_t c : t) ASSERT_LT(c, flat.size()) << what;
    const double twice = sign * turn(flat[t[0]], flat[t[1]], flat[t[2]]);
    sum += std::abs(twice);
    most_negative = std::min(most_negative, twice);
  }
  EXPECT_GE(most_negative, -1e-12 * std::abs(area)) << what;
  EXPECT_NEAR(sum, std::abs(area), 1e-9 * std::abs(area)) << what;
  EXPECT_TRUE(result.simple) << what;
  EXPECT_LE(result.triangles.size(), flat.size() - 2) << what;
}

void expect_covers(const Flat& flat, const std::string& what, const Place& place = {}) {
  expect_covers(flat, cut(flat, place), what);
}

// Begins at every corner and goes in both directions.
void expect_covers_from_all_corners(Flat flat, const std::string& what, const Place& place = {}) {
  for (int direction = 0; direction < 2; ++direction) {
    for (size_t i = 0; i < flat.size(); ++i) {
      std::rotate(flat.begin(), flat.begin() + 1, flat.end());
      expect_covers(flat, what, place);
    }
    std::reverse(flat.begin(), flat.end());
  }
}

TEST(Polygon, ConvexOnesAreFansAroundTheirFirstCorner) {
  HashStream random(1);
  for (size_t n = 3; n < 20; ++n) {
    Flat flat;
    for (size_t i = 0; i < n; ++i) {
      const double angle = 2 * 3.14159265358979 * static_cast<double>(i) / static_cast<double>(n);
      flat.push_back({3 * std::cos(angle), std::sin(angle)});
    }
    Triangles fan;
    for (uint32_t i = 2; i < n; ++i) fan.push_back({0, i - 1, i});
    EXPECT_EQ(cut(flat, random_place(random)).triangles, fan);
    std::reverse(flat.begin(), flat.end());
    EXPECT_EQ(cut(flat, random_place(random)).triangles, fan);
  }
}

TEST(Polygon, NotchesFromEveryCorner) {
  HashStream random(2);
  const std::pair<const char*, Flat> polygons[] = {
      {"L", {{2, 1}, {1, 1}, {1, 2}, {0, 2}, {0, 0}, {2, 0}}},
      {"arrow", {{0, 0}, {2, 1}, {0, 2}, {1, 1}}},
      {"U", {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}},
      {"plus", {{1, 0}, {2, 0}, {2, 1}, {3, 1}, {3, 2}, {2, 2}, {2, 3}, {1, 3}, {1, 2}, {0, 2}, {0, 1}, {1, 1}}},
      {"corners on edges", {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}},
      {"triangle with many corners", {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {2, 2}, {1, 1}}},
      {"corner in the line of an edge", {{0, 0}, {4, 0}, {4, 2}, {3, 1}, {2, 1}, {1, 1}, {0, 2}}},
      {"a corner twice", {{0, 0}, {2, 0}, {1, 1}, {2, 2}, {0, 2}, {1, 1}}},
      {"spike out", {{0, 0}, {2, 0}, {4, 0}, {2, 0}, {2, 2}, {0, 2}}},
      {"spike in", {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {2, 1}, {2, 2}, {0, 2}}}};
  for (const auto& [what, flat] : polygons) {
    expect_covers_from_all_corners(flat, what);
    for (int i = 0; i < 20; ++i) expect_covers_from_all_corners(flat, what, random_place(random));
  }
}

TEST(Polygon, HolesAtTheEndOfBridges) {
  HashStream random(3);
  const Flat one = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}};
  ASSERT_EQ(area_of(one), 2 * 12);
  // Two holes from one corner, the second by way of the first, and one that touches the outline.
  const Flat chain = {{0, 0}, {9, 0}, {9, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 2}, {2, 2},
                      {5, 2}, {5, 3}, {6, 3}, {6, 2}, {5, 2}, {2, 2}, {2, 1}, {1, 1}};
  ASSERT_EQ(area_of(chain), 2 * (36 - 1 - 1));
  const Flat touching = {{0, 0}, {2, 0}, {1, 1}, {2, 2}, {3, 1}, {2, 0}, {4, 0}, {4, 4}, {0, 4}};
  ASSERT_EQ(area_of(touching), 2 * 14);
  for (const Flat& flat : {one, chain, touching}) {
    expect_covers_from_all_corners(flat, "bridge");
    for (int i = 0; i < 20; ++i) expect_covers_from_all_corners(flat, "bridge", random_place(random));
  }
  // A board of 5 x 5 holes, each reached from the left edge of its row or from the hole before it.
  Flat board = {{0, 0}, {11, 0}, {11, 11}, {0, 11}};
  for (int row = 4; row >= 0; --row) {
    const double y = 2 * row + 1;
    Flat back;
    board.push_back({0, y});
    for (int i = 0; i < 5; ++i) {
      const double x = 2 * i + 1;
      board.insert(board.end(), {{x, y}, {x, y + 1}, {x + 1, y + 1}, {x + 1, y}});
      back.insert(back.begin(), {{x + 1, y}, {x, y}});
    }
    board.insert(board.end(), back.begin() + 1, back.end());
    board.push_back({0, y});
  }
  ASSERT_EQ(area_of(board), 2 * (121 - 25));
  expect_covers_from_all_corners(board, "board");
  for (int i = 0; i < 5; ++i) expect_covers_from_all_corners(board, "board", random_place(random));
}

// Random points, joined in a circle whose crossings are then untied.
Flat random_polygon(size_t n, HashStream& random) {
  Flat p;
  for (size_t i = 0; i < n; ++i)
    p.push_back({static_cast<double>(random.next_float()), static_cast<double>(random.next_float())});
  const auto cross = [&](size_t i, size_t k) {
    const auto &a = p[i], &b = p[i + 1], &c = p[k], &d = p[(k + 1) % n];
    return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
  };
  for (bool any = true; any;) {
    any = false;
    for (size_t i = 0; i + 2 < n; ++i)
      for (size_t k = i + 2; k < n; ++k)
        if ((k + 1) % n != i && cross(i, k)) {
          std::reverse(p.begin() + static_cast<std::ptrdiff_t>(i) + 1, p.begin() + static_cast<std::ptrdiff_t>(k) + 1);
          any = true;
        }
  }
  return p;
}

TEST(Polygon, RandomOnesAnywhere) {
  HashStream random(4);
  for (int i = 0; i < 400; ++i) {
    const size_t n = 4 + random.next_u32() % 60;
    const Flat flat = random_polygon(n, random);
    const Place place = random_place(random);
    const Cut result = cut(flat, place);
    expect_covers(flat, result, fmt::format("polygon {} of {}", i, n));
    EXPECT_EQ(result.triangles.size(), n - 2);
    EXPECT_EQ(cut(flat, place).triangles, result.triangles);
  }
}

// Polygons grow by squares, never over themselves, on a coarse grid, where corners meet and lie on edges of others.
TEST(Polygon, OutlinesOfCellsOnAGrid) {
  HashStream random(5);
  for (int i = 0; i < 200; ++i) {
    constexpr int kSide = 12;
    std::array<std::array<bool, kSide>, kSide> inside{};
    const auto has = [&](int x, int y) { return x >= 0 && y >= 0 && x < kSide && y < kSide && inside[x][y]; };
    inside[6][6] = true;
    for (int k = 0; k < 60; ++k) {
      const int x = static_cast<int>(random.next_u32() % kSide), y = static_cast<int>(random.next_u32() % kSide);
      if (has(x - 1, y) || has(x + 1, y) || has(x, y - 1) || has(x, y + 1)) inside[x][y] = true;
    }
    // The way goes along the outline with the cells on the left, turning right where two cells meet at a corner only:
    // holes that touch the outline there become part of it. Those that do not are not looked at.
    int x0 = 0, y0 = 0;
    while (!has(x0, y0)) x0 = (x0 + 1) % kSide, y0 += x0 == 0;
    Flat flat;
    int x = x0, y = y0, dx = 1, dy = 0;
    do {
      flat.push_back({static_cast<double>(x), static_cast<double>(y)});
      x += dx, y += dy;
      const auto cell = [&](int side) {  // ahead of the corner, to the right (0) or left (1)
        const int cx = x + (dx - 1 + (side ? -dy : dy)) / 2, cy = y + (dy - 1 + (side ? dx : -dx)) / 2;
        return has(cx, cy);
      };
      if (cell(0)) {
        std::swap(dx, dy), dy = -dy;
      } else if (!cell(1)) {
        std::swap(dx, dy), dx = -dx;
      }
    } while (x != x0 || y != y0 || dx != 1);
    expect_covers_from_all_corners(flat, fmt::format("outline {}", i));
    expect_covers_from_all_corners(flat, fmt::format("outline {}", i), random_place(random));
  }
}

TEST(Polygon, SaysWhichCrossThemselves) {
  HashStream random(6);
  Flat star;
  for (int i = 0; i < 5; ++i) star.push_back({std::cos(2.5132741 * i), std::sin(2.5132741 * i)});
  const std::pair<const char*, Flat> polygons[] = {
      {"bow tie", {{0, 0}, {1, 1}, {1, 0}, {0, 1}}},
      {"uneven bow tie", {{0, 0}, {3, 2}, {3, 0}, {0, 1}}},
      {"star", star},
      {"ring whose ends overlap",
       {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, -1}, {1, -1}, {1, 3}, {3, 3}, {3, 1}, {-1, 1}, {-1, 0}}},
      {"twice around", {{0, 0}, {2, 0}, {1, 1}, {0, 0}, {2, 0}, {1, 1}}},
      {"eight around a corner", {{0, 0}, {1, 1}, {2, 2}, {2, 0}, {1, 1}, {0, 2}}}};
  for (const auto& [what, flat] : polygons)
    for (int i = 0; i < 10; ++i) {
      const Cut result = cut(flat, i == 0 ? Place() : random_place(random));
      EXPECT_FALSE(result.simple) << what;
      EXPECT_GE(result.triangles.size(), 1u) << what;
      EXPECT_LE(result.triangles.size(), flat.size() - 2) << what;
    }
}

TEST(Polygon, WithoutAreaAnyTrianglesDo) {
  for (const Flat& flat :
       {Flat(4, {1, 1}), Flat{{0, 0}, {1, 0}, {2, 0}, {3, 0}}, Flat{{0, 0}, {1, 1}, {0, 0}, {1, 1}}}) {
    const Cut result = cut(flat);
    EXPECT_TRUE(result.simple);
    EXPECT_EQ(result.triangles.size(), 2u);
  }
}

// A polygon that is not quite flat, as modelled quads are.
TEST(Polygon, BentOnesAreCutAsSeenFromTheirFront) {
  PolygonCutter cutter;
  const std::vector<Point3d> arrow = {{0, 0, 0.1}, {2, 1, -0.1}, {0, 2, 0.1}, {1, 1, 0.3}};
  for (uint32_t first = 0; first < 4; ++first) {
    const uint32_t corners[] = {first, (first + 1) % 4, (first + 2) % 4, (first + 3) % 4};
    Triangles triangles;
    EXPECT_TRUE(cutter.cut(arrow, corners, triangles));
    ASSERT_EQ(triangles.size(), 2u);
    for (const auto& t : triangles) {
      EXPECT_GT(cross(arrow[t[1]] - arrow[t[0]], arrow[t[2]] - arrow[t[0]]).z, 0);
      EXPECT_TRUE(std::find(t.begin(), t.end(), 3u) != t.end());
    }
  }
}

void expect_fast(const Flat& flat, const std::string& what) {
  const std::clock_t start = std::clock();
  const Cut result = cut(flat);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  expect_covers(flat, result, what);
  EXPECT_LT(seconds, 10.0) << what;  // a fifth of a second here; comparing all with all takes minutes
}

TEST(Polygon, ManyCornersTakeSeconds) {
  constexpr int kCorners = 1 << 16;
  HashStream random(7);
  const auto unit = [](int i) { return static_cast<double>(i) / kCorners; };
  const auto around = [](double radius, double angle) {
    return std::array<double, 2>{radius * std::cos(angle), radius * std::sin(angle)};
  };
  Flat blob, star, spiral, comb, coast;
  for (int i = 0; i < kCorners; ++i) {
    blob.push_back(around(2 + std::cos(5 * 6.28318530717958 * unit(i)), 6.28318530717958 * unit(i)));
    star.push_back(around(1 + static_cast<double>(random.next_float()), 6.28318530717958 * unit(i)));
    // Teeth at 45 degrees.
    const double x = unit(i / 2 * 2);
    comb.push_back(i % 2 == 0 ? std::array<double, 2>{x, -x} : std::array<double, 2>{x + 1, 1 - x});
  }
  comb.push_back({1, -2}), comb.push_back({-1, 0});
  // A wall of one thickness, out and back, in turns so narrow that ears are at its ends only.
  for (int i = 0; i < kCorners / 2; ++i) spiral.push_back(around(1 + 40 * unit(i), 400 * unit(i) * 6.2831853));
  for (int i = kCorners / 2; i-- > 0;) spiral.push_back(around(1.03 + 40 * unit(i), 400 * unit(i) * 6.2831853));
  // All but four corners crowd in a millionth of the polygon.
  coast = {{0, 1}, {-1, 1}, {-1, -1}, {0, -1}};
  for (int i = 0; i < kCorners; ++i) coast.push_back({static_cast<double>(random.next_float()) * 1e-6, 1e-6 * unit(i)});
  expect_fast(blob, "blob");
  expect_fast(star, "star");
  expect_fast(spiral, "spiral");
  expect_fast(comb, "comb");
  expect_fast(coast, "coast");
}

}  // namespace
}  // namespace etd
