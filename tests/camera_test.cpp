// The cameras: angles of view, windows, handedness, precision, and what a lens does to rays.
#include "cameras/camera.h"

#include <gtest/gtest.h>

#include "model_uses.h"

namespace etd {
namespace {

Camera camera_of(const std::string& model, int width, int height, std::vector<Param> params,
                 const Transform& to_world = {}) {
  static CameraData data;
  Diagnostics diagnostics;
  const Camera c = make_camera(use_of(model, std::move(params)), {to_world, width, height, {}}, data, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors());
  return c;
}

Camera camera(int width, int height, std::vector<Param> params = {}, const Transform& to_world = {}) {
  return camera_of("perspective", width, height, std::move(params), to_world);
}

Vec3 direction(const Camera& c, float x, float y) { return c.generate_ray({{x, y}, {}, 0}).d; }

// tan of the angle to the axis, along x and y (up).
void expect_slopes(Vec3 d, float x, float y) {
  EXPECT_NEAR(length(d), 1.0f, 1e-6f);
  EXPECT_NEAR(d.x / d.z, x, 1e-5f);
  EXPECT_NEAR(d.y / d.z, y, 1e-5f);
}

TEST(PerspectiveCamera, FieldOfViewIsAlongTheShorterSide) {
  const Camera wide = camera(200, 100, {number("fov", 90)});
  expect_slopes(direction(wide, 100, 50), 0, 0);
  expect_slopes(direction(wide, 0, 0), -2, 1);  // top left; x grows to the right, y downwards
  expect_slopes(direction(wide, 200, 100), 2, -1);
  const Camera tall = camera(100, 300, {number("fov", 90)});
  expect_slopes(direction(tall, 0, 0), -1, 3);
  expect_slopes(direction(tall, 100, 300), 1, -3);
  const Camera narrow = camera(64, 64, {number("fov", 60)});
  expect_slopes(direction(narrow, 64, 0), std::tan(kPi / 6), std::tan(kPi / 6));
}

TEST(PerspectiveCamera, OnePixelSeesTheWholeField) {
  const Camera c = camera(1, 1);
  expect_slopes(direction(c, 0, 0), -1, 1);
  expect_slopes(direction(c, 0.5f, 0.5f), 0, 0);
  expect_slopes(direction(c, 1, 1), 1, -1);
}

TEST(PerspectiveCamera, FrameAspectAndScreenWindow) {
  const Camera squeezed = camera(100, 100, {number("frameaspectratio", 2)});
  expect_slopes(direction(squeezed, 0, 0), -2, 1);
  const Camera flat = camera(100, 100, {number("frameaspectratio", 0.5)});
  expect_slopes(direction(flat, 0, 0), -1, 2);
  const Camera window =
      camera(100, 50, {number("fov", 90), numbers("screenwindow", ParamKind::kFloat, {-0.5, 0.25, -1, 2})});
  expect_slopes(direction(window, 0, 0), -0.5f, 2);
  expect_slopes(direction(window, 100, 50), 0.25f, -1);
}

TEST(PerspectiveCamera, RejectsWindowsWithoutArea) {
  for (const std::vector<double>& window :
       {std::vector<double>{0, 0, 1, 2}, std::vector<double>{0, 1, 2, 2}, std::vector<double>{0, 1, 2}}) {
    Diagnostics diagnostics;
    CameraData data;
    make_camera(use_of("perspective", {numbers("screenwindow", ParamKind::kFloat, window)}), {{}, 10, 10, {}}, data,
                diagnostics);
    EXPECT_TRUE(diagnostics.has_errors());
  }
}

// Left-handed: looking along +z with y up, x is to the right. A world seen by LookAt from +z towards the origin
// therefore has its -x on the right: the mirror stands in the camera, never in the world.
TEST(PerspectiveCamera, HandednessOfLookAt) {
  const Transform to_world = Transform::look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}).inverse();
  const Camera c = camera(100, 100, {}, to_world);
  EXPECT_EQ(c.generate_ray({{50, 50}, {}, 0}).o, (Point3{0, 0, 5}));
  EXPECT_NEAR(direction(c, 50, 50).z, -1.0f, 1e-6f);
  EXPECT_GT(direction(c, 50, 0).y, 0.5f);
  EXPECT_LT(direction(c, 100, 50).x, -0.5f);
  // Scale -1 1 1 in front of it, as exporters from right-handed systems write, mirrors the picture.
  const Camera mirrored = camera(100, 100, {}, to_world * Transform::scale({-1, 1, 1}));
  EXPECT_GT(direction(mirrored, 100, 50).x, 0.5f);
}

TEST(PerspectiveCamera, ScaledSpacesAndTime) {
  const Camera c = camera(100, 100, {}, Transform::translate({1, 2, 3}) * Transform::scale({1e3, 1e3, 1e3}));
  const Ray ray = c.generate_ray({{25, 50}, {}, 0.75f});
  expect_slopes(ray.d, -0.5f, 0);
  EXPECT_EQ(ray.o, (Point3{1, 2, 3}));
  EXPECT_EQ(ray.time, 0.75f);
  EXPECT_EQ(ray.t_max, kInfinity);
}

// The transform is applied in double, so a camera far away from where it looks keeps its directions.
TEST(PerspectiveCamera, FarFromTheOrigin) {
  const Point3d eye{1e7, -2e7, 3e7};
  const Camera near_by = camera(640, 480, {}, Transform::look_at({0, 0, 0}, {1, 2, 3}, {0, 1, 0}).inverse());
  const Camera far =
      camera(640, 480, {}, Transform::look_at(eye, {eye.x + 1, eye.y + 2, eye.z + 3}, {0, 1, 0}).inverse());
  for (const float x : {0.0f, 333.25f, 639.5f})
    for (const float y : {0.5f, 240.0f, 480.0f})
      EXPECT_LT(length(direction(near_by, x, y) - direction(far, x, y)), 1e-6f);
}

void expect_near(Point3 p, Point3 q, float tolerance = 1e-5f) {
  EXPECT_NEAR(p.x, q.x, tolerance);
  EXPECT_NEAR(p.y, q.y, tolerance);
  EXPECT_NEAR(p.z, q.z, tolerance);
}

TEST(OrthographicCamera, RaysAreParallelAndFillTheWindow) {
  const Camera wide = camera_of("orthographic", 200, 100, {});
  for (const auto& [film, start] : {std::pair(Vec2{0, 0}, Point3{-2, 1, 0}),
                                    {{200, 100}, {2, -1, 0}},
                                    {{100, 50}, {0, 0, 0}},
                                    {{50, 75}, {-1, -0.5f, 0}}}) {
    const Ray ray = wide.generate_ray({film, {0.3f, 0.8f}, 0.25f});
    expect_near(ray.o, start);
    EXPECT_EQ(ray.d, (Vec3{0, 0, 1}));
    EXPECT_EQ(ray.time, 0.25f);
  }
  const Camera tall = camera_of("orthographic", 100, 100, {number("frameaspectratio", 0.5)});
  expect_near(tall.generate_ray({{0, 0}, {}, 0}).o, {-1, 2, 0});
  const Camera window = camera_of("orthographic", 30, 40, {numbers("screenwindow", ParamKind::kFloat, {-2, 1, -1, 3})});
  expect_near(window.generate_ray({{0, 0}, {}, 0}).o, {-2, 3, 0});
  expect_near(window.generate_ray({{30, 40}, {}, 0}).o, {1, -1, 0});
  expect_near(window.generate_ray({{10, 10}, {}, 0}).o, {-1, 2, 0});
}

TEST(OrthographicCamera, StandsWhereItsTransformPutsIt) {
  const Transform to_world = Transform::look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}).inverse();
  const Camera c = camera_of("orthographic", 100, 100, {}, to_world * Transform::scale({3, 3, 3}));
  const Ray ray = c.generate_ray({{100, 25}, {}, 0});
  expect_near(ray.o, {-3, 1.5f, 5});
  EXPECT_NEAR(length(ray.d - Vec3{0, 0, -1}), 0.0f, 1e-6f);
}

// Whatever point of the lens a ray leaves, it meets the pinhole's ray at the focal distance, in world units of a
// camera space that is turned and scaled.
TEST(Lens, FocusesOnAPlane) {
  const Transform to_world =
      Transform::look_at({1, 2, 3}, {4, 0, 1}, {0, 1, 0}).inverse() * Transform::scale({2, 2, 2});
  for (const char* model : {"perspective", "orthographic"}) {
    const Camera pinhole = camera_of(model, 64, 48, {}, to_world);
    const Camera lens = camera_of(model, 64, 48, {number("lensradius", 0.25), number("focaldistance", 3)}, to_world);
    const Vec3 forward = to_float(to_world.vector({0, 0, 0.5}));
    double mean_radius = 0;
    for (int i = 0; i < 16; ++i) {
      const float u = (static_cast<float>(i) + 0.5f) / 16;
      const Vec2 film{64 * u, 48 * std::fmod(5 * u, 1.0f)};
      const Ray a = pinhole.generate_ray({film, {}, 0});
      const Ray b = lens.generate_ray({film, {std::fmod(3 * u, 1.0f), std::fmod(7 * u, 1.0f)}, 0});
      EXPECT_NEAR(dot(b.o - a.o, forward), 0, 1e-5f);
      EXPECT_LE(length(b.o - a.o), 0.5f * (1 + 1e-5f));
      EXPECT_NEAR(length(b.d), 1, 1e-6f);
      mean_radius += length(b.o - a.o) / 16;
      // Both at depth 3 in camera space, 6 in the world.
      expect_near(a.o + a.d * (6 / dot(a.d, forward)), b.o + b.d * (6 / dot(b.d, forward)), 2e-5f);
    }
    EXPECT_GT(mean_radius, 0.2);  // the lens is used
  }
}

// The pole of the sphere is up; the equator begins at the right and goes through the front.
TEST(SphericalCamera, Equirectangular) {
  const Camera c =
      camera_of("spherical", 80, 40, {text("mapping", "equirectangular")}, Transform::translate({1, 2, 3}));
  const auto expect_direction = [&](float x, float y, Vec3 d) {
    EXPECT_LT(length(direction(c, x, y) - d), 1e-6f) << x << ' ' << y;
  };
  EXPECT_EQ(c.generate_ray({{7, 8}, {}, 0}).o, (Point3{1, 2, 3}));
  expect_direction(0, 20, {1, 0, 0});
  expect_direction(20, 20, {0, 0, 1});
  expect_direction(40, 20, {-1, 0, 0});
  expect_direction(60, 20, {0, 0, -1});
  expect_direction(33, 0, {0, 1, 0});
  expect_direction(12, 40, {0, -1, 0});
  const float diagonal = std::sqrt(0.5f);
  expect_direction(20, 10, {0, diagonal, diagonal});
  // Beyond the edges the picture goes on with what is there.
  expect_direction(-20, 20, {0, 0, -1});
  expect_direction(20, -10, {0, diagonal, -diagonal});
}

TEST(SphericalCamera, EqualArea) {
  const Camera c = camera_of("spherical", 64, 64, {});
  EXPECT_LT(length(direction(c, 32, 32) - Vec3{0, 1, 0}), 1e-6f);
  EXPECT_LT(length(direction(c, 0, 0) - Vec3{0, -1, 0}), 1e-6f);
  EXPECT_LT(length(direction(c, 64, 32) - Vec3{1, 0, 0}), 1e-6f);
  EXPECT_LT(length(direction(c, 32, 64) - Vec3{0, 0, 1}), 1e-6f);
  // Steps over each edge lead to the neighbours there, also from a corner and many images away.
  for (const auto& [out, in] : {std::pair(Vec2{-3, 10}, Vec2{3, 54}),
                                {{67, 10}, {61, 54}},
                                {{10, -3}, {54, 3}},
                                {{10, 67}, {54, 61}},
                                {{-3, -5}, {61, 59}},
                                {{128 + 9, -128 + 7}, {9, 7}}})
    EXPECT_LT(length(direction(c, out.x, out.y) - direction(c, in.x, in.y)), 1e-5f) << out.x << ' ' << out.y;
  // Equal areas: means of the coordinates and of their squares over the image are those over the sphere.
  Vec3d mean{}, squares{};
  constexpr int kSide = 256;
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) {
      const Vec3 d = direction(c, (static_cast<float>(i) + 0.5f) / 4, (static_cast<float>(j) + 0.5f) / 4);
      for (int k = 0; k < 3; ++k) {
        mean[k] += double{d[k]} / (kSide * kSide);
        squares[k] += sqr(double{d[k]}) / (kSide * kSide);
      }
    }
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(mean[k], 0, 1e-4);
    EXPECT_NEAR(squares[k], 1.0 / 3, 1e-3);
  }
}

}  // namespace
}  // namespace etd
