// The footprint of a pixel against the rays of neighbouring pixels, for every camera.
#include "cameras/footprint.h"

#include <gtest/gtest.h>

#include "core/frame.h"
#include "model_uses.h"

namespace etd {
namespace {

Camera camera_of(const ModelUse& use, const Transform& to_world, int width, int height) {
  static CameraData data;
  Diagnostics diagnostics;
  const Camera camera = make_camera(use, {to_world, width, height, {}}, data, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << diagnostics.format_all();
  return camera;
}

// Returns where the ray of a place on the film meets a plane.
Point3 on_plane(const Camera& camera, float x, float y, Point3 p, Vec3 n) {
  const Ray ray = camera.generate_ray({{x, y}, {0.5f, 0.5f}, 0.5f});
  return ray.o + ray.d * (dot(p - ray.o, n) / dot(ray.d, n));
}

const Transform kPlace = Transform::translate({3, -2, 5}) * Transform::rotate(40, {1, 3, -2});

// In the middle of a narrow picture, and anywhere in a parallel projection, the step is that of the rays.
TEST(PixelFootprint, IsTheStepBetweenPixels) {
  const int width = 200, height = 100;
  for (const ModelUse& use : {use_of("perspective", {number("fov", 4)}), use_of("orthographic")}) {
    const Camera camera = camera_of(use, kPlace, width, height);
    const PixelFootprint footprint(camera, width, height, 1.0f);
    for (const Vec3 tilt : {Vec3{0, 0, 1}, Vec3{1, 0, 1}, Vec3{0.5f, -2, 1}, Vec3{-3, 1, -1}})
      for (const float distance : {1.0f, 30.0f}) {
        const Ray middle = camera.generate_ray({{100, 50}, {0.5f, 0.5f}, 0.5f});
        const Point3 p = middle.o + middle.d * distance;
        const Vec3 n = normalize(to_float(kPlace.vector(to_double(tilt))));
        const Vec3 dx = on_plane(camera, 101, 50, p, n) - p, dy = on_plane(camera, 100, 51, p, n) - p;
        const PixelFootprint::Step step = footprint.at(p, n);
        EXPECT_LT(length(step.dx - dx), 0.02f * length(dx)) << use.model;
        // The other axis is right up to its sign, which no filter sees.
        EXPECT_LT(std::min(length(step.dy - dy), length(step.dy + dy)), 0.02f * length(dy)) << use.model;
        EXPECT_NEAR(dot(step.dx, n), 0.0f, 1e-3f * length(dx));
      }
  }
}

// Elsewhere it is smaller, so that no texture is too blurred; a panorama's rows near the poles decide for all.
TEST(PixelFootprint, IsNeverLargerThanAPixel) {
  const int width = 120, height = 60;
  for (const ModelUse& use : {use_of("perspective", {number("fov", 90)}), use_of("spherical"),
                              use_of("perspective", {number("lensradius", 0.1), number("focaldistance", 4)})}) {
    const Camera camera = camera_of(use, kPlace, width, height);
    const PixelFootprint footprint(camera, width, height, 1.0f);
    float largest = 0;
    for (float x = 10; x < 120; x += 20)
      for (float y = 8; y < 56; y += 8) {
        const Ray ray = camera.generate_ray({{x, y}, {0.5f, 0.5f}, 0.5f});
        const Point3 p = ray.o + ray.d * 7.0f;
        const PixelFootprint::Step step = footprint.at(p, ray.d);
        const float dx = length(on_plane(camera, x + 0.5f, y, p, ray.d) - on_plane(camera, x - 0.5f, y, p, ray.d));
        const float dy = length(on_plane(camera, x, y + 0.5f, p, ray.d) - on_plane(camera, x, y - 0.5f, p, ray.d));
        EXPECT_LE(length(step.dx), 1.01f * dx) << use.model;
        EXPECT_LE(length(step.dy), 1.01f * dy) << use.model;
        largest = std::max(largest, length(step.dy) / dy);
      }
    EXPECT_GT(largest, 0.5f) << use.model;
  }
}

TEST(PixelFootprint, FiniteWherePlacesAreStrange) {
  const PixelFootprint footprint(camera_of(use_of("perspective"), kPlace, 64, 64), 64, 64, 1.0f);
  for (const Point3 p : {Point3{3, -2, 5}, Point3{3, -2, 5.0001f}, Point3{1e18f, 0, 0}, Point3{0, 0, 0}})
    for (const Vec3 n : {Vec3{1, 0, 0}, Vec3{0, 0, 1}, normalize(cross(p - Point3{3, -2, 5}, {1, 2, 3}))}) {
      if (!is_finite(n)) continue;
      const PixelFootprint::Step step = footprint.at(p, n);
      EXPECT_TRUE(is_finite(step.dx) && is_finite(step.dy));
    }
  const PixelFootprint none;
  EXPECT_EQ(length(none.at({1, 2, 3}, {0, 0, 1}).dx), 0.0f);
}

TEST(PixelFootprint, ShrinksWithTheSamplesDownToAnEighth) {
  EXPECT_EQ(PixelFootprint::scale_for(0), 1.0f);
  EXPECT_EQ(PixelFootprint::scale_for(1), 1.0f);
  EXPECT_EQ(PixelFootprint::scale_for(16), 0.25f);
  EXPECT_EQ(PixelFootprint::scale_for(1u << 30), 0.125f);
}

}  // namespace
}  // namespace etd
