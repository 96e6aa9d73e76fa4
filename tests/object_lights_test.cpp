// Lights inside of objects: none without an instance, one for each instance, where and how the instance puts it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "formats/pbrt/reader.h"
#include "render_helper.h"
#include "scene/compile.h"
#include "scene/info.h"
#include "scene/place_lights.h"
#include "scene/scene.h"

namespace etd {
namespace {

constexpr const char* kView = R"(
Film "rgb" "integer xresolution" 12 "integer yresolution" 8
PixelFilter "box"
Sampler "independent" "integer pixelsamples" 4
Integrator "path" "integer maxdepth" 2
LookAt 0 1 4  0 0 0  0 1 0
Camera "perspective" "float fov" 50 "float shutterclose" 1
WorldBegin
Shape "trianglemesh" "point3 P" [ -3 -1 -3  3 -1 -3  3 -1 3  -3 -1 3 ] "integer indices" [ 0 1 2 0 2 3 ]
Shape "sphere" "float radius" 0.7
)";

CompiledScene compile_world(const std::string& world, Diagnostics& diagnostics) {
  const std::string folder = source_path("tests/scenes/closed").string();
  return compile(read_pbrt_text(kView + world, "test", folder, diagnostics), {12, 8}, diagnostics);
}

std::shared_ptr<const Scene> scene_of(const std::string& world, Diagnostics& diagnostics) {
  return compile_world(world, diagnostics).scene;
}

std::string in_object(const std::string& light) { return "ObjectBegin \"o\"\n" + light + "\nObjectEnd\n"; }

// The two worlds look the same, and not black.
void expect_same_picture(const std::string& a, const std::string& b) {
  const std::vector<float> pa = picture(render_text(kView + a, "tests/scenes/closed", {}));
  const std::vector<float> pb = picture(render_text(kView + b, "tests/scenes/closed", {}));
  double sum = 0;
  for (size_t i = 0; i < pa.size(); ++i) {
    EXPECT_NEAR(pa[i], pb[i], 1e-4 * (1e-3 + std::abs(pb[i]))) << i;
    sum += static_cast<double>(pb[i]);
  }
  EXPECT_GT(sum, 0);
}

struct Kind {
  std::string name, light;
};

class ObjectLight : public ::testing::TestWithParam<Kind> {};

TEST_P(ObjectLight, ShinesOnceForEachInstance) {
  const std::string& light = GetParam().light;
  Diagnostics diagnostics;
  const auto [none, none_info] = compile_world(in_object(light), diagnostics);
  ASSERT_TRUE(none) << diagnostics.format_all();
  EXPECT_TRUE(none->lights.empty());
  EXPECT_TRUE(none_info->summary.lights.empty());
  EXPECT_NE(diagnostics.format_all().find("shines nowhere, because its object has no instance"), std::string::npos);

  Diagnostics none_wrong;
  const auto [two, two_info] =
      compile_world(in_object(light) + "ObjectInstance \"o\"\nTranslate 0.5 0 0\nObjectInstance \"o\"\n", none_wrong);
  ASSERT_TRUE(two) << none_wrong.format_all();
  ASSERT_EQ(two->lights.size(), 2u);
  EXPECT_EQ(two_info->summary.lights.begin()->second, 2u);
  EXPECT_EQ(two_info->names.lights.size(), 2u);
  EXPECT_EQ(luminance(two->lights[0].power()), luminance(two->lights[1].power()));
  // Both are chosen alike by power, and in a quarter of all cases by what the camera gets of them.
  EXPECT_GE(two->light_sampler.probability(0, nullptr), 0.375f);
  EXPECT_GE(two->light_sampler.probability(1, nullptr), 0.375f);
}

// Also where the instance mirrors, and where objects stand in objects.
TEST_P(ObjectLight, IsWhereItsInstancePutsIt) {
  const std::string& light = GetParam().light;
  const std::string place = "Translate 0.4 -0.2 0.3\nRotate 25 1 2 3\nScale -1 1 1\n";
  expect_same_picture(in_object(light) + place + "ObjectInstance \"o\"\n", place + light);
  const std::string inner = "Rotate 40 0 1 0\n";
  expect_same_picture(in_object(light) + "ObjectBegin \"p\"\n" + inner + "ObjectInstance \"o\"\nObjectEnd\n" + place +
                          "ObjectInstance \"p\"\n",
                      place + inner + light);
}

TEST_P(ObjectLight, MovesWithItsInstance) {
  const std::string& light = GetParam().light;
  // A light with a transform of its own would turn around another point in the second world.
  const std::string turn = light.find("Attribute") == std::string::npos ? "Rotate 30 0 0 1\n" : "";
  const std::string place =
      "Rotate 20 0 1 0\nActiveTransform EndTime\nTranslate 0.3 0 0.1\n" + turn + "ActiveTransform All\n";
  expect_same_picture(in_object(light) + place + "ObjectInstance \"o\"\n", place + light);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, ObjectLight,
    ::testing::Values(
        Kind{"Point", "LightSource \"point\" \"point3 from\" [ 1 2 1 ] \"rgb I\" [ 4 3 2 ]"},
        Kind{"Spot", "LightSource \"spot\" \"point3 from\" [ 1 3 1 ] \"point3 to\" [ 0.2 0 0 ] \"rgb I\" [ 9 9 8 ]"},
        Kind{"Distant", "LightSource \"distant\" \"point3 from\" [ 1 2 0.5 ] \"point3 to\" [ 0 0 0 ]"},
        Kind{"Infinite", "LightSource \"infinite\" \"rgb L\" [ 0.5 0.6 0.7 ]"},
        Kind{"Sky", "LightSource \"infinite\" \"string filename\" \"parts/latlong_quadrants.pfm\""},
        Kind{"Goniometric",
             "AttributeBegin\nTranslate 0 2.5 0\nLightSource \"goniometric\" \"string filename\" "
             "\"parts/gonio_halves.pfm\" \"rgb I\" [ 5 5 5 ]\nAttributeEnd"},
        Kind{"Projection",
             "AttributeBegin\nTranslate 0 3 0\nRotate 90 1 0 0\nLightSource \"projection\" \"string filename\" "
             "\"parts/slide.pfm\" \"float fov\" 80 \"float scale\" 9\nAttributeEnd"}),
    [](const auto& kind) { return kind.param.name; });

TEST(ObjectLights, APortalBelongsToTheObjectToo) {
  const std::string portal =
      "LightSource \"infinite\" \"point3 portal\" [ -1 3 -1  1 3 -1  1 3 1  -1 3 1 ] \"rgb L\" [ 3 3 3 ]\n";
  expect_same_picture(
      in_object(portal) + "Translate 0.5 0.25 0\nObjectInstance \"o\"\n",
      "LightSource \"infinite\" \"point3 portal\" [ -0.5 3.25 -1  1.5 3.25 -1  1.5 3.25 1  -0.5 3.25 1 ] "
      "\"rgb L\" [ 3 3 3 ]\n");
}

TEST(ObjectLights, AFileIsReadOnceForAllInstances) {
  Diagnostics diagnostics;
  const std::string lamp =
      "LightSource \"goniometric\" \"string filename\" \"parts/gonio_halves.pfm\"\n"
      "LightSource \"projection\" \"string filename\" \"parts/slide.pfm\"\n";
  const auto scene =
      scene_of(in_object(lamp) + "ObjectInstance \"o\"\nTranslate 1 0 0\nObjectInstance \"o\"\n", diagnostics);
  ASSERT_TRUE(scene) << diagnostics.format_all();
  EXPECT_EQ(scene->lights.size(), 4u);
  EXPECT_EQ(scene->light_data.environments.size(), 1u);
  EXPECT_EQ(scene->light_data.images.size(), 1u);
  EXPECT_EQ(scene->light_data.grids.size(), 1u);
}

TEST(ObjectLights, MistakesCountWithoutAnInstanceToo) {
  for (const char* light :
       {"LightSource \"point\" \"float scal\" 2", "LightSource \"goniometric\" \"string filename\" \"absent.pfm\"",
        "LightSource \"spot\" \"point3 from\" [ 0 0 1 ] \"point3 to\" [ 0 0 1 ]"}) {
    Diagnostics diagnostics;
    EXPECT_FALSE(scene_of(in_object(light), diagnostics)) << light;
    EXPECT_EQ(diagnostics.error_count(), 1) << diagnostics.format_all();
  }
}

TEST(ObjectLights, ManyFromInfinitelyFarAwayAreNoted) {
  Diagnostics diagnostics;
  scene_of(in_object("LightSource \"infinite\"") + "ObjectInstance \"o\"\nObjectInstance \"o\"\nObjectInstance \"o\"\n",
           diagnostics);
  EXPECT_NE(diagnostics.format_all().find("shines 3 times, once for each instance of its object"), std::string::npos)
      << diagnostics.format_all();
}

// Objects that double 40 times ask for 10^12 lights in a few lines.
TEST(ObjectLights, HaveALimit) {
  std::string world = "ObjectBegin \"o0\"\nLightSource \"point\"\nObjectEnd\n";
  for (int i = 1; i <= 40; ++i)
    world +=
        fmt::format("ObjectBegin \"o{}\"\nObjectInstance \"o{}\"\nTranslate 1 0 0\nObjectInstance \"o{}\"\nObjectEnd\n",
                    i, i - 1, i - 1);
  Diagnostics diagnostics;
  const SceneDescription scene =
      read_pbrt_text("WorldBegin\n" + world + "ObjectInstance \"o40\"\n", "test", ".", diagnostics);
  for (const PlacedLight& placed : place_lights(scene, diagnostics)) EXPECT_TRUE(placed.places.empty());
  EXPECT_NE(diagnostics.format_all().find("the limit is 1000000; --limit copies=N raises it"), std::string::npos)
      << diagnostics.format_all();
}

// Next-event estimation, power and choice of lights know all of them.
TEST(ObjectLights, TwoLampsGiveTwiceTheLight) {
  const auto mean = [](const std::string& instances) {
    const std::string text = R"(Film "rgb" "integer xresolution" 4 "integer yresolution" 4
Integrator "path" "integer maxdepth" 1
LookAt 0 0 .5  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [ -.01 .01 -.01 .01 ]
WorldBegin
ObjectBegin "lamp"
  LightSource "point" "point3 from" [ 0 0 1 ]
ObjectEnd
)" + instances + "Shape \"disk\" \"float radius\" 9\n";
    const std::vector<float> p = picture(render_text(text, ".", {}));
    double sum = 0;
    for (const float v : p) sum += static_cast<double>(v);
    return sum / static_cast<double>(p.size());
  };
  EXPECT_EQ(mean(""), 0);
  EXPECT_NEAR(mean("ObjectInstance \"lamp\"\n"), 0.5 / M_PI, 1e-4);
  EXPECT_NEAR(mean("ObjectInstance \"lamp\"\nObjectInstance \"lamp\"\n"), 1 / M_PI, 5e-3);
}

}  // namespace
}  // namespace etd
