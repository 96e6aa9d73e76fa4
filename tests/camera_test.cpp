// The perspective camera: angles of view, windows, handedness, and precision.
#include "cameras/camera.h"

#include <gtest/gtest.h>

#include "model_uses.h"

namespace etd {
namespace {

Camera camera(int width, int height, std::vector<Param> params = {}, const Transform& to_world = {}) {
  Diagnostics diagnostics;
  const Camera c = make_camera(use_of("perspective", std::move(params)), {to_world, width, height}, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors());
  return c;
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
    make_camera(use_of("perspective", {numbers("screenwindow", ParamKind::kFloat, window)}), {{}, 10, 10}, diagnostics);
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

}  // namespace
}  // namespace etd
