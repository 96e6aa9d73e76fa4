// Warps without statistics: the density must be the reciprocal of the numeric Jacobian of the map.
#include "core/warp.h"

#include <gtest/gtest.h>

namespace etd {
namespace {

// Central difference of fourth order of warp(u) along one axis.
template <class Warp>
Vec3d derivative(Warp&& warp, Vec2 u, Vec2 axis, float h) {
  const auto at = [&](float t) { return to_double(warp(Vec2{u.x + axis.x * t, u.y + axis.y * t})); };
  return ((at(h) - at(-h)) * 8.0 - (at(2.0f * h) - at(-2.0f * h))) / (12.0 * static_cast<double>(h));
}

// Checks |d warp / du.x  x  d warp / du.y| pdf(warp(u)) = 1 on a grid of points for which usable(u).
template <class Warp, class Pdf, class Usable>
void expect_density(Warp&& warp, Pdf&& pdf, Usable&& usable) {
  constexpr float kStep = 0.004f;
  for (float x = 0.0237f; x < 0.98f; x += 0.0613f) {
    for (float y = 0.0419f; y < 0.97f; y += 0.0571f) {
      if (!usable(Vec2{x, y})) continue;
      const Vec3d dx = derivative(warp, {x, y}, {1, 0}, kStep), dy = derivative(warp, {x, y}, {0, 1}, kStep);
      EXPECT_NEAR(length(cross(dx, dy)) * pdf(warp({x, y})), 1.0, 2e-3) << x << ' ' << y;
    }
  }
}

bool anywhere(Vec2) { return true; }
// The concentric map has a kink along the diagonals of the square.
bool off_diagonals(Vec2 u) { return std::abs(u.x - u.y) > 0.02f && std::abs(u.x + u.y - 1.0f) > 0.02f; }
// Malley's hemisphere is also too steep at the horizon for finite differences.
bool off_horizon(Vec2 u) { return off_diagonals(u) && std::max(std::abs(u.x - 0.5f), std::abs(u.y - 0.5f)) < 0.46f; }
Vec3 in_plane(Vec2 v) { return {v.x, v.y, 0.0f}; }

TEST(Warp, ConcentricDisk) {
  expect_density([](Vec2 u) { return in_plane(sample_disk_concentric(u)); }, [](Vec3) { return pdf_disk(); },
                 off_diagonals);
  EXPECT_EQ(sample_disk_concentric({0.5f, 0.5f}), (Vec2{0, 0}));
}

TEST(Warp, CosineHemisphere) {
  expect_density([](Vec2 u) { return sample_hemisphere_cosine(u); }, [](Vec3 w) { return pdf_hemisphere_cosine(w.z); },
                 off_horizon);
  EXPECT_EQ(pdf_hemisphere_cosine(-0.5f), 0.0f);
}

TEST(Warp, UniformSphere) {
  expect_density([](Vec2 u) { return sample_sphere_uniform(u); }, [](Vec3) { return pdf_sphere_uniform(); }, anywhere);
}

TEST(Warp, UniformTriangle) {
  // Barycentrics cover a triangle of area 1/2.
  expect_density([](Vec2 u) { return in_plane(sample_triangle_uniform(u)); }, [](Vec3) { return 2.0f; }, off_diagonals);
  for (Vec2 u : {Vec2{0, 0}, Vec2{kOneMinusEpsilon, 0}, Vec2{0.3f, 0.9f}, Vec2{kOneMinusEpsilon, kOneMinusEpsilon}}) {
    const Vec2 b = sample_triangle_uniform(u);
    EXPECT_TRUE(b.x >= 0.0f && b.y >= 0.0f && b.x + b.y <= 1.0f);
  }
}

TEST(Warp, StaysOnItsDomainAtTheCorners) {
  for (float x : {0.0f, 0.5f, kOneMinusEpsilon}) {
    for (float y : {0.0f, 0.5f, kOneMinusEpsilon}) {
      EXPECT_NEAR(length(sample_hemisphere_cosine({x, y})), 1.0f, 1e-6f);
      EXPECT_GE(sample_hemisphere_cosine({x, y}).z, 0.0f);
      EXPECT_NEAR(length(sample_sphere_uniform({x, y})), 1.0f, 1e-6f);
    }
  }
}

}  // namespace
}  // namespace etd
