// What moves in scenes: shapes, instances in instances, lights and pictures.
#include <gtest/gtest.h>

#include "formats/pbrt/reader.h"
#include "render_helper.h"
#include "scene/compile.h"
#include "scene/info.h"
#include "scene/scene.h"

namespace etd {
namespace {

CompiledScene compile_world(const std::string& world) {
  Diagnostics diagnostics;
  const SceneDescription d = read_pbrt_text("Camera \"perspective\"\nWorldBegin\n" + world, "test", {}, diagnostics);
  CompiledScene compiled = compile(d, {64, 64}, diagnostics);
  EXPECT_TRUE(compiled.scene) << diagnostics.format_all();
  return compiled;
}

std::shared_ptr<const Scene> scene_of(const std::string& world) { return compile_world(world).scene; }

// Returns where a ray at this time meets the scene, in its file's coordinates.
std::optional<Point3d> look(const Scene& scene, Point3d from, Vec3 direction, float time) {
  Hit hit;
  if (!scene.intersect({to_float(from - scene.origin), direction, kInfinity, time}, hit)) return {};
  return to_double(scene.surface(hit).point.p) + scene.origin;
}

const std::string kMoveX = "ActiveTransform EndTime Translate 2 0 0 ActiveTransform All\n";

TEST(Motion, WhatMovesAloneHasASpaceOfItsOwn) {
  const auto [scene, info] = compile_world("Translate 0 0 5\nShape \"sphere\" \"float radius\" 1\n" + kMoveX +
                                           "Shape \"sphere\" \"float radius\" 0.5\n");
  EXPECT_TRUE(scene->moves);
  EXPECT_EQ(scene->geometry.instances.size(), 1u);
  EXPECT_EQ(scene->geometry.groups.size(), 2u);
  EXPECT_NEAR(info->summary.bounds.hi.x, 2.5, 1e-6);
  EXPECT_NEAR(look(*scene, {2, 0, 0}, {0, 0, 1}, 1.0f)->z, 4.5, 1e-5);
  EXPECT_NEAR(look(*scene, {1.25, 0, 0}, {0, 0, 1}, 0.5f)->z, 5 - std::sqrt(0.25 - 0.0625), 1e-5);
  EXPECT_FALSE(look(*scene, {2, 0, 0}, {0, 0, 1}, 0.5f));
}

TEST(Motion, StillScenesDoNotMove) {
  EXPECT_FALSE(scene_of("Shape \"sphere\"\nLightSource \"point\"\n")->moves);
  EXPECT_TRUE(scene_of(kMoveX + "LightSource \"point\"\n")->moves);
}

// A ball on an arm that turns, on a cart that moves; placed once, and as two instances, which share it.
TEST(Motion, MotionsNest) {
  const std::string objects =
      "ObjectBegin \"arm\"\nRotate 30 0 0 1\nTranslate 1 0 0\nShape \"sphere\" \"float radius\" 0.1\nObjectEnd\n"
      "ObjectBegin \"cart\"\nShape \"disk\" \"float radius\" 0.1\n"
      "ActiveTransform EndTime Rotate 90 0 0 1 ActiveTransform All\nObjectInstance \"arm\"\nObjectEnd\n";
  const std::string one =
      "AttributeBegin\nTranslate 0 0 4\n" + kMoveX + "Scale 1 1 1\nObjectInstance \"cart\"\nAttributeEnd\n";
  const std::string other = "AttributeBegin\nTranslate 0 0 9\nScale 2 1 1\nObjectInstance \"cart\"\nAttributeEnd\n";
  for (const bool shared : {false, true}) {
    const auto scene = scene_of(objects + one + (shared ? other : ""));
    EXPECT_EQ(scene->geometry.instances.size(), shared ? 4u : 2u);
    EXPECT_EQ(scene->geometry.quadrics.size(), 2u);
    for (const float time : {0.0f, 0.3f, 0.77f, 1.0f}) {
      const double angle = radians(30 + 90 * static_cast<double>(time)), x = 2 * static_cast<double>(time);
      const auto ball = look(*scene, {x + std::cos(angle), std::sin(angle), 0}, {0, 0, 1}, time);
      ASSERT_TRUE(ball);
      EXPECT_NEAR(ball->z, 3.9, 1e-4);
      EXPECT_NEAR(look(*scene, {x, 0, 0}, {0, 0, 1}, time)->z, 4, 1e-5);
      if (!shared) continue;
      const auto stretched = look(*scene, {2 * std::cos(angle), std::sin(angle), 5}, {0, 0, 1}, time);
      ASSERT_TRUE(stretched);
      EXPECT_NEAR(stretched->z, 8.9, 1e-3);
    }
  }
}

// Lights in objects that several moving instances place are lights at each of them.
TEST(Motion, LightsMoveWithTheirInstances) {
  const std::string lamp =
      "ObjectBegin \"lamp\"\nAreaLightSource \"diffuse\"\nShape \"sphere\" \"float radius\" 0.5\nObjectEnd\n";
  const auto scene = scene_of(lamp + "Translate 0 0 5\n" + kMoveX +
                              "ObjectInstance \"lamp\"\nTranslate 0 3 0\nScale 2 2 2\n" + "ObjectInstance \"lamp\"\n");
  ASSERT_EQ(scene->lights.size(), 2u);
  const uint32_t small = scene->lights[0].power()[0] < scene->lights[1].power()[0] ? 0 : 1;
  const Light& light = scene->lights[small];
  EXPECT_NEAR(scene->lights[1 - small].power()[0] / light.power()[0], 4, 1e-4);
  const Point3 p = to_float(Point3d{1, 0, 0} - scene->origin);
  for (const float time : {0.0f, 0.5f, 1.0f}) {
    const auto s = light.sample_li(p, {0.3f, 0.6f}, {time});
    ASSERT_TRUE(s);
    const Point3d at = to_double(s->on_light.p) + scene->origin;
    EXPECT_NEAR(length(at - Point3d{2 * static_cast<double>(time), 0, 5}), 0.5, 1e-5);
    Hit hit;
    ASSERT_TRUE(scene->intersect({p, s->wi, kInfinity, time}, hit));
    const SurfaceHit seen = scene->surface(hit);
    EXPECT_EQ(seen.light, small);
    EXPECT_LT(length(seen.point.p - s->on_light.p), 1e-4f);
    EXPECT_NEAR(light.pdf_li(p, s->wi, &seen.point, {time}) / s->pdf, 1.0f, 1e-3f);
  }
}

// A translation is the same as an instance and as vertices at two moments: the same paths make nearly the same picture.
TEST(Motion, AnInstanceMovesAsItsVerticesDo) {
  const std::string head =
      "Film \"rgb\" \"integer xresolution\" 32 \"integer yresolution\" 32\nLookAt 0 -6 3  0 0 0  0 0 1\n"
      "Camera \"perspective\" \"float fov\" 40\nWorldBegin\nLightSource \"infinite\"\nMaterial \"diffuse\"\n"
      "Shape \"disk\" \"float radius\" 3 \"float height\" -1\n";
  const std::string vertices = "-1 -1 0  1 -1 0  0 1 0  0 0 1.5 ",
                    moved = "0 -0.5 0.2  2 -0.5 0.2  1 1.5 0.2  1 0.5 1.7 ";
  const std::string indices = "\"integer indices\" [ 0 2 1  0 1 3  1 2 3  2 0 3 ]\n";
  const std::string instance = head + "ActiveTransform EndTime Translate 1 0.5 0.2 ActiveTransform All\n" +
                               "Shape \"trianglemesh\" \"point3 P\" [ " + vertices + "] " + indices;
  const std::string baked =
      head + "Shape \"trianglemesh\" \"integer motionsteps\" 2 \"point3 P\" [ " + vertices + moved + "] " + indices;
  RenderOverrides o;
  o.spp = 16;
  const Film a = render_text(instance, "tests/scenes/closed", o), b = render_text(baked, "tests/scenes/closed", o);
  int different = 0;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) different += std::abs(value(a.total(x, y), {}) - value(b.total(x, y), {})) > 1e-4;
  EXPECT_LE(different, 10);
  EXPECT_NEAR(image_mean(a).mean(), image_mean(b).mean(), 1e-3);
}

}  // namespace
}  // namespace etd
