// Solid angles in closed form, and samples that are uniform in them: the Jacobian of a warp from the square to
// directions is the solid angle everywhere, which needs no statistics.
#include "core/solid_angle.h"

#include <gtest/gtest.h>

#include "core/hash.h"
#include "core/transform.h"
#include "lights/light_surfaces.h"

namespace etd {
namespace {

constexpr Point3d kOrigin{};

// Calls f with points of the square and the numeric Jacobian of `direction` there.
template <class Direction, class F>
void for_jacobians(Direction direction, F f) {
  constexpr float kStep = 0x1p-12f;
  HashStream numbers(1);
  for (int i = 0; i < 500; ++i) {
    const float x = 0.01f + 0.98f * numbers.next_float(), y = 0.01f + 0.98f * numbers.next_float();
    const Vec3d du = direction({x + kStep, y}) - direction({x - kStep, y});
    const Vec3d dv = direction({x, y + kStep}) - direction({x, y - kStep});
    const auto width = [&](float a) { return static_cast<double>((a + kStep) - (a - kStep)); };
    f(Vec2{x, y}, length(cross(du, dv)) / (width(x) * width(y)));
  }
}

TEST(SphericalTriangle, OctantIsAnEighth) {
  const Point3d corners[3] = {{1, 0, 0}, {0, 2, 0}, {0, 0, 5}};
  EXPECT_NEAR(SphericalTriangle(kOrigin, corners).solid_angle(), kPiD / 2, 1e-14);
}

TEST(SphericalRectangle, FaceOfACubeIsASixth) {
  EXPECT_NEAR(SphericalRectangle(kOrigin, {{-1, -1, 1}, {2, 0, 0}, {0, 2, 0}}).solid_angle(), 4 * kPiD / 6, 1e-13);
  EXPECT_EQ(SphericalRectangle(kOrigin, {{1, 1, 0}, {2, 0, 0}, {0, 2, 0}}).solid_angle(), 0.0);
}

TEST(SphericalRectangle, IsTwoTriangles) {
  HashStream numbers(2);
  const auto number = [&] { return 2.0 * static_cast<double>(numbers.next_float()) - 1.0; };
  for (int i = 0; i < 1000; ++i) {
    const Transform t = Transform::rotate(300 * number(), {number(), number(), 1});
    const Vec3d x = t.vector({0.1 + std::abs(number()), 0, 0}), y = t.vector({0, 0.1 + std::abs(number()), 0});
    const Point3d o = t.point({number(), number(), 0.05 + std::abs(number())});
    const Point3d one[3] = {o, o + x, o + y}, two[3] = {o + x, o + x + y, o + y};
    const double sum = SphericalTriangle(kOrigin, one).solid_angle() + SphericalTriangle(kOrigin, two).solid_angle();
    EXPECT_NEAR(SphericalRectangle(kOrigin, {o, x, y}).solid_angle(), sum, 1e-12);
  }
}

// From next to its plane a rectangle is a hemisphere or nothing, and from afar hardly more than nothing.
TEST(SphericalRectangle, IsRightInTheLimits) {
  const auto solid_angle = [](double x, double y, double distance) {
    return SphericalRectangle(kOrigin, {{x, y, distance}, {2, 0, 0}, {0, 3, 0}}).solid_angle();
  };
  for (double distance = 1e-3; distance > 1e-300; distance *= 1e-3) {
    EXPECT_NEAR(solid_angle(-1, -1, distance), 2 * kPiD, 6 * distance + 1e-7);
    for (const auto& [x, y] :
         {std::pair{3.0, -1.0}, {-5.0, -1.0}, {-1.0, 7.0}, {-1.0, -7.0}, {4.0, 4.0}, {-9.0, 4.0}}) {
      EXPECT_GE(solid_angle(x, y, distance), 0.0);
      EXPECT_LE(solid_angle(x, y, distance), 6 * distance + 1e-7);
    }
  }
  for (const double distance : {1e3, 1e5, 1e7, 1e9}) {
    EXPECT_NEAR(solid_angle(-1, -1, distance), 6 / sqr(distance), 1e-4 / sqr(distance) + 1e-15);
    EXPECT_GE(solid_angle(5, 7, distance), 0.0);
  }
}

// Large, small, slanted, and seen from close by.
TEST(SphericalTriangle, SamplesAreUniform) {
  const Point3d all[][3] = {{{1, 0, 0}, {0, 2, 0}, {0, 0, 5}},
                            {{1, 0, 1}, {1, 0.02, 1}, {1.01, 0.01, 1}},
                            {{-3, -2, 0.1}, {4, -1, 0.1}, {0, 3, 0.1}},
                            {{-1, 2, 0.3}, {1, 2, 0.3}, {0.1, 40, 0.3}}};
  for (const auto& corners : all) {
    const SphericalTriangle triangle(kOrigin, corners);
    ASSERT_GT(triangle.solid_angle(), kSmallSolidAngle);
    for_jacobians([&](Vec2 u) { return triangle.sample(u); },
                  [&](Vec2 u, double jacobian) {
                    EXPECT_NEAR(jacobian / triangle.solid_angle(), 1.0, 2e-3) << u.x << " " << u.y;
                  });
  }
}

TEST(SphericalRectangle, SamplesAreUniform) {
  const struct {
    Point3d corner;
    Vec3d x, y;
  } all[] = {{{-1, -1, 1}, {2, 0, 0}, {0, 2, 0}},
             {{2, 1, 0.3}, {1, 0, 0}, {0, 3, 0}},
             {{-3, -2, 0.2}, {5, 0, 0}, {0, 7, 0}},
             {{5, 7, 3}, {0.08, 0, 0}, {0, 0.06, 0}}};
  for (const auto& r : all) {
    const SphericalRectangle rectangle(kOrigin, {r.corner, r.x, r.y});
    ASSERT_GT(rectangle.solid_angle(), kSmallSolidAngle);
    const auto direction = [&](Vec2 u) {
      const Vec2T<double> at = rectangle.sample(u);
      return normalize(r.corner + r.x * at.x + r.y * at.y - kOrigin);
    };
    for_jacobians(direction, [&](Vec2 u, double jacobian) {
      EXPECT_NEAR(jacobian / rectangle.solid_angle(), 1.0, 2e-3) << u.x << " " << u.y;
    });
  }
}

// The distances go from grazing the ball to so far away that it is a point for floats.
TEST(SphericalCap, SamplesAreUniformAndOnTheNearSide) {
  for (const double distance : {1.001, 1.5, 10.0, 1e4}) {
    const Point3d center = kOrigin + normalize(Vec3d{1, -2, 0.5}) * distance;
    const auto cap = SphericalCap::seen_from(kOrigin, center, 1.0);
    ASSERT_TRUE(cap);
    EXPECT_NEAR(cap->solid_angle(), 2 * kPiD * (1 - std::sqrt(1 - 1 / sqr(distance))),
                1e-8 * cap->solid_angle() + 1e-15);
    const auto direction = [&](Vec2 u) { return normalize(center + cap->sample_normal(u) - kOrigin); };
    for_jacobians(direction, [&](Vec2 u, double jacobian) {
      EXPECT_NEAR(jacobian / cap->solid_angle(), 1.0, 2e-3) << distance << ": " << u.x << " " << u.y;
      const Vec3d n = cap->sample_normal(u);
      EXPECT_NEAR(length(n), 1.0, 1e-12);
      EXPECT_LE(dot(n, direction(u)), 1e-6);
    });
  }
  EXPECT_FALSE(SphericalCap::seen_from(kOrigin, {0.5, 0, 0}, 1.0));
  EXPECT_FALSE(SphericalCap::seen_from(kOrigin, {1, 0, 0}, 1.0));
}

// Whatever p is, samples are finite and on the surface.
TEST(LightSurfaces, SamplesStayOnTheSurface) {
  Mesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const auto found = LightRectangle::find(mesh, 0);
  ASSERT_TRUE(found);
  const RectangleSurface rectangle(*found);
  EXPECT_FLOAT_EQ(rectangle.area(), 4.0f);
  const TriangleSurface triangle(mesh, 0);
  HashStream numbers(3);
  const auto inside = [](const SurfacePoint& s) {
    return std::abs(s.p.x) <= 1.0f && std::abs(s.p.y) <= 1.0f && std::abs(s.p.z) <= 1e-6f;
  };
  for (int i = 0; i < 20000; ++i) {
    const auto number = [&] { return 2.0f * numbers.next_float() - 1.0f; };
    const float scale = std::pow(10.0f, 3.0f * number()), height = std::pow(10.0f, 4.0f * number());
    const Point3 p{scale * number(), scale * number(), i % 2 ? height : -1e-3f * height};
    const Vec2 u{numbers.next_float(), i % 100 ? numbers.next_float() : 0.0f};
    if (const auto view = rectangle.seen_from(p)) {
      ASSERT_TRUE(inside(view->sample(u))) << p.x << " " << p.y << " " << p.z;
    }
    if (const auto view = triangle.seen_from(p)) {
      const SurfacePoint s = view->sample(u);
      ASSERT_TRUE(inside(s)) << p.x << " " << p.y << " " << p.z;
      ASSERT_LE(s.p.y, s.p.x + 1e-6f);
    }
  }
}

bool is_rectangle(std::vector<Point3> positions, std::array<uint32_t, 3> a, std::array<uint32_t, 3> b) {
  Mesh mesh;
  mesh.positions = std::move(positions);
  mesh.triangles = {a, b};
  return LightRectangle::find(mesh, 0).has_value();
}

TEST(RectangleSurface, IsFoundHoweverItIsSplit) {
  const std::vector<Point3> square{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, {0, 0, 0}, {2, 1, 0}};
  EXPECT_TRUE(is_rectangle(square, {0, 1, 2}, {0, 2, 3}));
  EXPECT_TRUE(is_rectangle(square, {2, 0, 1}, {3, 0, 2}));
  EXPECT_TRUE(is_rectangle(square, {0, 1, 3}, {1, 2, 3}));
  EXPECT_TRUE(is_rectangle(square, {0, 1, 2}, {4, 5, 3}));
  EXPECT_TRUE(is_rectangle(square, {1, 0, 2}, {2, 0, 3}));
  EXPECT_FALSE(is_rectangle(square, {0, 1, 2}, {0, 3, 2}));  // they face different sides
  EXPECT_FALSE(is_rectangle(square, {0, 1, 2}, {0, 1, 2}));
  EXPECT_FALSE(is_rectangle(square, {0, 1, 2}, {0, 1, 3}));
}

TEST(RectangleSurface, IsNotSeenInOtherQuads) {
  const std::array<uint32_t, 3> a{0, 1, 2}, b{0, 2, 3};
  EXPECT_FALSE(is_rectangle({{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 1, 0}}, a, b));      // parallelogram
  EXPECT_FALSE(is_rectangle({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1.5f, 0}}, a, b));   // trapezoid
  EXPECT_FALSE(is_rectangle({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0.01f}}, a, b));  // bent
  EXPECT_FALSE(is_rectangle({{0, 0, 0}, {0, 0, 0}, {2, 1, 0}, {0, 1, 0}}, a, b));      // a triangle and nothing
}

}  // namespace
}  // namespace etd
