// The grammar, the state and the defaults of the pbrt-v4 reader on correct scenes. What it says about broken ones is
// pinned in broken_scenes_test.cpp.
#include "formats/pbrt/reader.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

#include "shared_path.h"
#include "temp_folder.h"

namespace etd {
namespace {

namespace fs = std::filesystem;

struct Reading {
  explicit Reading(std::string text, bool allow_unsupported = false) : diagnostics(allow_unsupported) {
    scene = read_pbrt_text(std::move(text), "test.pbrt", ".", diagnostics);
  }
  std::string messages() const { return diagnostics.format_all(); }
  Diagnostics diagnostics;
  SceneDescription scene;
};

Point3d apply(const Transform& t, Point3d p) { return t.point(p); }
void expect_near(Point3d a, Point3d b) {
  EXPECT_NEAR(a.x, b.x, 1e-12);
  EXPECT_NEAR(a.y, b.y, 1e-12);
  EXPECT_NEAR(a.z, b.z, 1e-12);
}

TEST(PbrtReader, FillsTheDefaultsOfTheFormat) {
  const Reading r("WorldBegin");
  EXPECT_EQ(r.messages(), "");
  EXPECT_EQ(r.scene.camera.model, "perspective");
  EXPECT_EQ(r.scene.film.model, "rgb");
  EXPECT_EQ(r.scene.filter.model, "gaussian");
  EXPECT_EQ(r.scene.sampler.model, "sobol");
  EXPECT_EQ(r.scene.integrator.model, "path");
  EXPECT_TRUE(r.scene.camera_to_world.start.is_identity());
}

TEST(PbrtReader, ReadsParametersOfAllTypesInBothBracketStyles) {
  const Reading r(R"(WorldBegin
Shape "sphere" # a comment "with quotes" [ and brackets
  "float radius" 2.5  "integer n" [ 1 -2 +3 ]  "bool a" true "bool b" [ false ] "bool c" "true" "bool d" [ "false" ]
  "string s" "quoted \"name\"\\"  "string t" ["x" "y"]
  "point p" [1 2 3] "point3 q" [1 2 3] "vector v" [1 2 3] "vector3 w" [1 2 3] "normal m" [0 0 1] "normal3 k" [0 0 1]
  "point2 uv" [0 1 1 0] "vector2 d2" [ 1 1 ]
  "rgb c1" [.1 1. 1e-1] "spectrum c2" "metal-Cu-eta" "spectrum c3" [400 1 700 2] "blackbody c4" 6500)");
  EXPECT_EQ(r.messages(), "");
  ASSERT_EQ(r.scene.shapes.size(), 1u);
  const ModelUse& use = r.scene.shapes[0].use;
  ASSERT_EQ(use.params.size(), 20u);
  EXPECT_EQ(use.find("radius")->numbers, std::vector<double>{2.5});
  EXPECT_EQ(use.find("n")->integers, (std::vector<int32_t>{1, -2, 3}));
  for (const auto& [name, value] : {std::pair{"a", 1}, {"b", 0}, {"c", 1}, {"d", 0}})
    EXPECT_EQ(use.find(name)->integers, std::vector<int32_t>{value}) << name;
  EXPECT_EQ(use.find("s")->strings, std::vector<std::string>{"quoted \"name\"\\"});
  EXPECT_EQ(use.find("t")->strings, (std::vector<std::string>{"x", "y"}));
  EXPECT_EQ(use.find("p")->kind, ParamKind::kPoint3);
  EXPECT_EQ(use.find("v")->kind, ParamKind::kVector3);
  EXPECT_EQ(use.find("k")->kind, ParamKind::kNormal);
  EXPECT_EQ(use.find("c1")->numbers, (std::vector<double>{0.1, 1.0, 0.1}));
  EXPECT_EQ(use.find("c2")->strings, std::vector<std::string>{"metal-Cu-eta"});
  EXPECT_EQ(use.find("c3")->numbers.size(), 4u);
  EXPECT_EQ(use.find("radius")->loc.line, 3);
  EXPECT_EQ(use.find("radius")->loc.column, 3);
  EXPECT_EQ(use.find("radius")->loc.length, 14);
}

TEST(PbrtReader, CameraToWorldInvertsTheTransformAtTheCamera) {
  const Reading r(
      "LookAt 1 2 3  1 2 0  0 1 0\nCamera \"perspective\" \"float fov\" 30\nWorldBegin\n"
      "CoordSysTransform \"camera\"\nShape \"sphere\"\nCoordSysTransform \"world\"\nShape \"sphere\"");
  EXPECT_EQ(r.messages(), "");
  expect_near(apply(r.scene.camera_to_world.start, {0, 0, 0}), {1, 2, 3});
  expect_near(apply(r.scene.camera_to_world.start, {0, 0, 2}), {1, 2, 1});
  ASSERT_EQ(r.scene.shapes.size(), 2u);
  expect_near(apply(r.scene.shapes[0].to_world.start, {0, 0, 2}), {1, 2, 1});
  EXPECT_TRUE(r.scene.shapes[1].to_world.start.is_identity());
}

TEST(PbrtReader, TransformsComposeFromTheRight) {
  const Reading r(R"(Scale -1 1 1
WorldBegin
AttributeBegin
  Translate 1 2 3
  Rotate 90 0 0 1
  Scale 2 2 2
  Shape "sphere"
AttributeEnd
Shape "sphere"
Transform [ 1 0 0 0  0 1 0 0  0 0 1 0  5 6 7 1 ]
CoordinateSystem "here"
ConcatTransform [ 2 0 0 0  0 2 0 0  0 0 2 0  0 0 0 1 ]
Shape "sphere"
Identity
CoordSysTransform "here"
Shape "sphere")");
  EXPECT_EQ(r.messages(), "");
  ASSERT_EQ(r.scene.shapes.size(), 4u);
  expect_near(apply(r.scene.shapes[0].to_world.start, {1, 0, 0}), {1, 4, 3});
  EXPECT_TRUE(r.scene.shapes[1].to_world.start.is_identity());
  expect_near(apply(r.scene.shapes[2].to_world.start, {1, 1, 1}), {7, 8, 9});
  expect_near(apply(r.scene.shapes[3].to_world.start, {1, 1, 1}), {6, 7, 8});
}

TEST(PbrtReader, AttributesAreSavedAndRestored) {
  const Reading r(R"(WorldBegin
Material "diffuse" "rgb reflectance" [1 0 0]
AttributeBegin
  Material "diffuse" "rgb reflectance" [0 1 0]
  AreaLightSource "diffuse" "rgb L" [1 1 1]
  ReverseOrientation
  Shape "sphere"
  TransformBegin
    Translate 1 0 0
    Shape "sphere"
  TransformEnd
  Shape "sphere"
AttributeEnd
Shape "sphere")");
  EXPECT_EQ(r.diagnostics.error_count(), 0);
  ASSERT_EQ(r.scene.shapes.size(), 4u);
  EXPECT_EQ(r.scene.shapes[0].material, 1);
  EXPECT_EQ(r.scene.shapes[0].area_light, 0);
  EXPECT_TRUE(r.scene.shapes[0].reverse_orientation);
  EXPECT_FALSE(r.scene.shapes[1].to_world.start.is_identity());
  EXPECT_TRUE(r.scene.shapes[2].to_world.start.is_identity());
  EXPECT_EQ(r.scene.shapes[3].material, 0);
  EXPECT_EQ(r.scene.shapes[3].area_light, -1);
  EXPECT_FALSE(r.scene.shapes[3].reverse_orientation);
}

TEST(PbrtReader, NamedThingsAreResolvedAlsoBeforeTheirDefinition) {
  const Reading r(R"(WorldBegin
ObjectInstance "two"
NamedMaterial "late"
Shape "sphere"
MakeNamedMaterial "late" "string type" "diffuse" "texture reflectance" "t"
Texture "t" "spectrum" "constant" "rgb value" [ 1 0 0 ]
Texture "t" "float" "constant" "float value" 1
ObjectBegin "one"
  Translate 1 0 0
  Shape "sphere"
ObjectEnd
ObjectBegin "two"
  ObjectInstance "one"
ObjectEnd
Translate 0 1 0
ObjectInstance "one")");
  EXPECT_EQ(r.messages(), "");
  ASSERT_EQ(r.scene.materials.size(), 1u);
  EXPECT_EQ(r.scene.materials[0].name, "late");
  EXPECT_EQ(r.scene.materials[0].use.model, "diffuse");
  EXPECT_EQ(r.scene.shapes[0].material, 0);
  ASSERT_EQ(r.scene.textures.size(), 2u);
  ASSERT_EQ(r.scene.objects.size(), 2u);
  EXPECT_EQ(r.scene.objects[0].shapes.size(), 1u);
  expect_near(apply(r.scene.objects[0].shapes[0].to_world.start, {0, 0, 0}), {1, 0, 0});
  ASSERT_EQ(r.scene.objects[1].instances.size(), 1u);
  EXPECT_EQ(r.scene.objects[1].instances[0].object, 0);
  ASSERT_EQ(r.scene.instances.size(), 2u);
  EXPECT_EQ(r.scene.instances[0].object, 1);
  EXPECT_EQ(r.scene.instances[1].object, 0);
  expect_near(apply(r.scene.instances[1].to_world.start, {0, 0, 0}), {0, 1, 0});
}

TEST(PbrtReader, AttributeGivesDefaultParameters) {
  const Reading r(R"(WorldBegin
Attribute "shape" "float radius" 2
AttributeBegin
  Attribute "shape" "float radius" 3
  Shape "sphere"
  Shape "sphere" "float radius" 4
AttributeEnd
Shape "sphere"
Attribute "light" "float scale" 5
LightSource "infinite" "rgb L" [1 1 1]
AreaLightSource "diffuse")");
  EXPECT_EQ(r.messages(), "");
  ASSERT_EQ(r.scene.shapes.size(), 3u);
  EXPECT_EQ(r.scene.shapes[0].use.find("radius")->numbers[0], 3);
  EXPECT_EQ(r.scene.shapes[1].use.find("radius")->numbers[0], 4);
  EXPECT_EQ(r.scene.shapes[2].use.find("radius")->numbers[0], 2);
  EXPECT_EQ(r.scene.lights[0].use.find("scale")->numbers[0], 5);
  EXPECT_EQ(r.scene.area_lights[0].find("scale")->numbers[0], 5);
}

TEST(PbrtReader, SamplersAndIntegratorsMapToOurs) {
  const Reading r(R"(Sampler "stratified" "integer xsamples" 3 "integer ysamples" 5 "bool jitter" true
Integrator "bdpt" "integer maxdepth" 7 "bool visualizestrategies" false
Option "seed" 42
WorldBegin)");
  EXPECT_EQ(r.diagnostics.error_count(), 0);
  EXPECT_EQ(r.scene.sampler.model, "sobol");
  EXPECT_EQ(r.scene.sampler.find("pixelsamples")->integers[0], 15);
  EXPECT_EQ(r.scene.sampler.find("seed")->integers[0], 42);
  EXPECT_EQ(r.scene.sampler.params.size(), 2u);
  EXPECT_EQ(r.scene.integrator.model, "path");
  EXPECT_EQ(r.scene.integrator.find("maxdepth")->integers[0], 7);
  EXPECT_EQ(r.scene.integrator.params.size(), 1u);
  EXPECT_NE(r.messages().find(
                "note: sampler \"stratified\" is rendered with \"sobol\", without its xsamples, ysamples, jitter"),
            std::string::npos)
      << r.messages();
  EXPECT_NE(r.messages().find("note: integrator \"bdpt\" is rendered with \"path\", without its visualizestrategies"),
            std::string::npos)
      << r.messages();
  EXPECT_EQ(Reading("Sampler \"stratified\" \"integer pixelsamples\" 9\nWorldBegin")
                .scene.sampler.find("pixelsamples")
                ->integers[0],
            9);
  EXPECT_EQ(Reading("Sampler \"paddedsobol\" \"integer pixelsamples\" 4\nWorldBegin").messages(), "");
  EXPECT_EQ(Reading("Sampler \"independent\" \"integer pixelsamples\" 4\nWorldBegin").scene.sampler.model,
            "independent");
}

TEST(PbrtReader, HarmlessValuesAndOptionsPassInSilence) {
  const Reading r(R"(Option "disablepixeljitter" false
Option "rendercoordsys" "world"
ColorSpace "srgb"
TransformTimes 0 1
ActiveTransform StartTime
ActiveTransform All
MediumInterface "" ""
Camera "spherical" "float lensradius" 0.5 "float focaldistance" 10
Film "rgb" "float diagonal" 35
WorldBegin
Shape "trianglemesh" "integer faceIndices" 1
Material "dielectric" "float roughness" 0 "bool remaproughness" true)");
  EXPECT_EQ(r.messages(), "");
  EXPECT_TRUE(r.scene.film.params.empty());
  EXPECT_TRUE(r.scene.camera.params.empty());
  EXPECT_TRUE(r.scene.shapes[0].use.params.empty());
}

TEST(PbrtReader, UnsupportedModelsAreReplacedWhenAllowed) {
  const Reading r(R"(WorldBegin
Material "hair" "rgb color" [ 0.1 0.2 0.3 ] "float beta_m" 0.1
Shape "loopsubdiv" "point3 P" [0 0 0 1 0 0 0 1 0] "integer indices" [0 1 2]
Shape "curve"
Texture "m" "spectrum" "ptex" "string filename" "m.ptx")",
                  true);
  EXPECT_EQ(r.diagnostics.error_count(), 0);
  EXPECT_EQ(r.diagnostics.all().size(), 4u);
  EXPECT_EQ(r.scene.materials[0].use.model, "diffuse");
  ASSERT_EQ(r.scene.materials[0].use.params.size(), 1u);
  EXPECT_EQ(r.scene.materials[0].use.params[0].name, "reflectance");
  ASSERT_EQ(r.scene.shapes.size(), 1u);
  EXPECT_EQ(r.scene.shapes[0].use.model, "trianglemesh");
  EXPECT_EQ(r.scene.shapes[0].use.find("indices")->integers, (std::vector<int32_t>{0, 1, 2}));
  EXPECT_EQ(r.scene.textures[0].use.model, "constant");
  EXPECT_EQ(r.scene.textures[0].use.find("value")->numbers, std::vector<double>{0.5});
}

TEST(PbrtReader, ActiveTransformMovesWhatFollows) {
  const Reading r(R"(TransformTimes 2 5
ActiveTransform StartTime Translate 0 0 1 ActiveTransform EndTime Translate 0 0 3 ActiveTransform All
Camera "perspective"
WorldBegin
Translate 1 0 0
AttributeBegin
ActiveTransform EndTime Translate 0 1 0
Shape "sphere"
LightSource "point"
ObjectInstance "o"
AttributeEnd
Shape "sphere"
ObjectBegin "o"
ObjectEnd)");
  EXPECT_EQ(r.messages(), "");
  EXPECT_EQ(r.scene.motion_start, 2);
  EXPECT_EQ(r.scene.motion_end, 5);
  expect_near(apply(r.scene.camera_to_world.start, {0, 0, 0}), {0, 0, -1});
  expect_near(apply(r.scene.camera_to_world.end, {0, 0, 0}), {0, 0, -3});
  for (const TransformPair& t :
       {r.scene.shapes[0].to_world, r.scene.lights[0].to_world, r.scene.instances[0].to_world}) {
    expect_near(apply(t.start, {0, 0, 0}), {1, 0, 0});
    expect_near(apply(t.end, {0, 0, 0}), {1, 1, 0});
  }
  EXPECT_FALSE(r.scene.shapes[1].to_world.is_moving());
}

TEST(PbrtReader, MegabytesOfNumbersAreReadQuickly) {
  std::string text = "WorldBegin Shape \"trianglemesh\" \"point3 P\" [";
  for (int i = 0; text.size() < (4u << 20); ++i) text += fmt::format(" {:.6f} -1.5e-3 {}", i * 0.001, i);
  text += " ]";
  const auto start = std::chrono::steady_clock::now();
  const Reading r(std::move(text));
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  RecordProperty("seconds", std::to_string(seconds));
  EXPECT_EQ(r.messages(), "");
  EXPECT_LT(seconds, 5.0);  // 0.05 s on a quiet machine in a release build; sanitizers need more
}

TEST(PbrtReader, ReadsTheSharedScenes) {
  const fs::path folder = shared_path("scenes/pbrt");
  if (folder.empty()) GTEST_SKIP() << "../shared/scenes/pbrt is absent";
  int scenes = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".pbrt") continue;
    Diagnostics d(true);
    const SceneDescription scene = read_pbrt(entry.path(), d);
    EXPECT_FALSE(d.has_errors()) << d.format_all();
    EXPECT_FALSE(scene.shapes.empty()) << entry.path();
    ++scenes;
  }
  EXPECT_GE(scenes, 9);
}

}  // namespace
}  // namespace etd
