// Holes in surfaces: rays go on behind them as they are, and what is said about lights that are not there. The light
// that comes through is tested by the scenes alpha_*.pbrt of tests/scenes/closed.
#include <gtest/gtest.h>

#include "core/hash.h"
#include "formats/pbrt/reader.h"
#include "scene/compile.h"
#include "scene/scene.h"

namespace etd {
namespace {

std::shared_ptr<const Scene> compile_text(const std::string& text, Diagnostics& diagnostics) {
  const SceneDescription description = read_pbrt_text("WorldBegin " + text, "test", ".", diagnostics);
  return compile(description, {16, 16}, diagnostics).scene;
}

// Ten layers, each there by a half, and one that is: what a ray meets first is distributed geometrically.
TEST(Alpha, LayersAreIndependentOfEachOther) {
  std::string text = "Translate 0 0 -5 ";
  for (int i = 0; i < 10; ++i) text += "Translate 0 0 1 Shape \"disk\" \"float radius\" 5 \"float alpha\" 0.5 ";
  text += "Translate 0 0 1 Shape \"disk\" \"float radius\" 5";
  Diagnostics diagnostics;
  const auto scene = compile_text(text, diagnostics);
  ASSERT_TRUE(scene) << diagnostics.format_all();
  EXPECT_TRUE(scene->has_holes);
  constexpr int kRays = 40000;
  std::vector<int> met(11);
  HashStream h(1);
  for (int i = 0; i < kRays; ++i) {
    Ray ray{{h.next_float(), h.next_float(), -20}, {0, 0, 1}};
    Hit hit, again;
    ASSERT_TRUE(scene->intersect(ray, hit));
    ++met[hit.primitive];
    ASSERT_TRUE(scene->intersect(ray, again));
    ASSERT_EQ(hit.primitive, again.primitive);
    // What lies before the hit is free, and what is met is in the way.
    ray.t_max = hit.t;
    ASSERT_FALSE(scene->occluded(ray));
    ray.t_max = hit.t * 1.0001f;
    ASSERT_TRUE(scene->occluded(ray));
  }
  for (int i = 0; i < 11; ++i) {
    const double share = std::pow(0.5, std::min(i + 1, 10));
    EXPECT_NEAR(met[static_cast<size_t>(i)], share * kRays, 5 * std::sqrt(share * kRays)) << i;
  }
}

// Points on a coin of two materials: both faces of a sphere with holes are met at their own places.
TEST(Alpha, TheFarSideOfASphereIsMetThroughTheNearOne) {
  Diagnostics diagnostics;
  const auto scene = compile_text("Shape \"sphere\" \"float alpha\" 0.3", diagnostics);
  ASSERT_TRUE(scene) << diagnostics.format_all();
  int near = 0, far = 0;
  HashStream h(2);
  for (int i = 0; i < 20000; ++i) {
    Hit hit;
    if (!scene->intersect({{0.2f * h.next_float(), 0.2f * h.next_float(), -3}, {0, 0, 1}}, hit)) continue;
    ++(hit.t < 3 ? near : far);
    EXPECT_EQ(hit.t < 3, scene->surface(hit).point.p.z < 0);
  }
  EXPECT_NEAR(near, 6000, 350);
  EXPECT_NEAR(far, 4200, 300);
}

TEST(Alpha, OneHasNoHolesAndZeroIsNotThere) {
  Diagnostics diagnostics;
  const auto scene = compile_text(
      "Shape \"sphere\" \"float alpha\" 1 Shape \"sphere\" \"float alpha\" 0 \"float radius\" 3", diagnostics);
  ASSERT_TRUE(scene) << diagnostics.format_all();
  EXPECT_FALSE(scene->has_holes);
  EXPECT_EQ(scene->geometry.quadrics.size(), 1u);
}

TEST(Alpha, AnAreaLightOfNoneShinesAndIsMetByNoRay) {
  for (const char* shape : {"\"sphere\"", "\"disk\"", "\"trianglemesh\" \"point3 P\" [ -1 -1 0  1 -1 0  0 1 0 ]",
                            "\"bilinearmesh\" \"point3 P\" [ -1 -1 0  1 -1 1  -1 1 0  1 1 0 ]"}) {
    Diagnostics diagnostics;
    const auto scene = compile_text(std::string("Shape \"sphere\" \"float radius\" 0.1 AreaLightSource \"diffuse\" ") +
                                        "\"bool twosided\" true Shape " + shape + " \"float alpha\" 0",
                                    diagnostics);
    ASSERT_TRUE(scene) << diagnostics.format_all();
    ASSERT_EQ(scene->lights.size(), 1u) << shape;
    EXPECT_TRUE(scene->lights[0].is_delta());
    const Point3 above{0.1f, 0.1f, 3};
    const auto s = scene->lights[0].sample_li(above, {0.4f, 0.3f}, {});
    ASSERT_TRUE(s) << shape;
    EXPECT_TRUE(s->is_delta && max_value(s->radiance) > 0);
    Hit hit;
    EXPECT_FALSE(scene->intersect({{0.5f, 0.1f, 3}, {0, 0, -1}}, hit)) << shape;  // beside the small ball
  }
  Diagnostics missing;
  EXPECT_FALSE(compile_text("Shape \"sphere\" \"texture alpha\" \"holes\"", missing));
  EXPECT_NE(missing.format_all().find("there is no float texture \"holes\""), std::string::npos);
}

}  // namespace
}  // namespace etd
