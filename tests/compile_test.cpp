// Tests the way from a description to a scene: instances, recentring, orientation, what is left out, and that all
// mistakes are told together.
#include "scene/compile.h"

#include <gtest/gtest.h>

#include "formats/pbrt/reader.h"
#include "scene/info.h"
#include "scene/scene.h"
#include "temp_folder.h"

namespace etd {
namespace {

const std::string kTriangle = "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1 0 ] ";
const std::string kLight = "AreaLightSource \"diffuse\" \"rgb L\" [ 2 2 2 ] ";

CompiledScene compile_world(const std::string& world, Diagnostics& diagnostics,
                            const std::filesystem::path& folder = {}, const std::string& camera = "") {
  const SceneDescription d =
      read_pbrt_text(camera + "Camera \"perspective\"\nWorldBegin\n" + world, "test", folder, diagnostics);
  return compile(d, {64, 64}, diagnostics);
}

// `camera`: transforms in front of it.
CompiledScene compiled_of(const std::string& world, const std::string& camera = "") {
  Diagnostics diagnostics;
  CompiledScene compiled = compile_world(world, diagnostics, {}, camera);
  EXPECT_TRUE(compiled.scene) << diagnostics.format_all();
  return compiled;
}

std::shared_ptr<const Scene> scene_of(const std::string& world, const std::string& camera = "") {
  return compiled_of(world, camera).scene;
}

// The surface that a ray from a point of the file's world meets.
std::optional<SurfaceHit> look(const Scene& scene, Point3d from, Vec3 direction) {
  Hit hit;
  if (!scene.intersect({to_float(from - scene.origin), direction, kInfinity, 0}, hit)) return {};
  return scene.surface(hit);
}

TEST(Compile, EmptyWorlds) {
  const auto [scene, info] = compiled_of("");
  EXPECT_TRUE(info->summary.bounds.empty());
  EXPECT_FALSE(look(*scene, {0, 0, 0}, {0, 0, 1}));
  EXPECT_FALSE(scene->light_sampler.sample(0.5, nullptr));
  const auto [only_light, only_light_info] = compiled_of("LightSource \"infinite\"");
  EXPECT_EQ(only_light->infinite_lights.size(), 1u);
  EXPECT_EQ(only_light_info->summary.lights.at("infinite"), 1u);
  const auto [invisible, invisible_info] = compiled_of("Material \"interface\"\n" + kTriangle + "\nShape \"sphere\"\n");
  EXPECT_TRUE(invisible->geometry.meshes.empty());
  EXPECT_TRUE(invisible->geometry.quadrics.empty());
  EXPECT_TRUE(invisible_info->summary.bounds.empty());
}

TEST(Compile, AnInstanceUsedOnceBecomesPartOfTheWorld) {
  const auto [scene, info] = compiled_of("ObjectBegin \"o\"\n Translate 0 0 1 " + kTriangle +
                                         "\nShape \"sphere\"\nObjectEnd\n"
                                         "Translate 5 0 0 ObjectInstance \"o\"\n");
  EXPECT_EQ(scene->geometry.groups.size(), 1u);
  EXPECT_TRUE(scene->geometry.instances.empty());
  EXPECT_EQ(info->summary.triangles, 1u);
  EXPECT_EQ(info->summary.shapes.at("sphere"), 1u);
  EXPECT_TRUE(look(*scene, {5.25, 0.25, 7}, {0, 0, -1}));
}

TEST(Compile, SharedObjectsAreStoredOnce) {
  const auto [scene, info] =
      compiled_of("ObjectBegin \"o\" " + kTriangle +
                  " Translate 0 0 5 Shape \"sphere\" ObjectEnd\n"
                  "ObjectBegin \"unused\" " +
                  kTriangle +
                  " ObjectEnd\n"
                  "AttributeBegin Translate 10 0 0 ObjectInstance \"o\" AttributeEnd\n"
                  "AttributeBegin Translate -10 0 0 Scale 2 2 2 ObjectInstance \"o\" AttributeEnd\n" +
                  kTriangle);
  EXPECT_EQ(scene->geometry.groups.size(), 2u);
  EXPECT_EQ(scene->geometry.instances.size(), 2u);
  EXPECT_EQ(scene->geometry.meshes.size(), 2u);
  EXPECT_EQ(info->summary.triangles, 2u);
  EXPECT_EQ(info->summary.instanced_triangles, 3u);
  for (const Point3d from : {Point3d{10.25, 0.25, -3}, Point3d{-9.5, 0.5, -3}, Point3d{0.25, 0.25, -3}}) {
    const auto hit = look(*scene, from, {0, 0, 1});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->point.p.z + scene->origin.z, 0, 1e-5);
  }
  EXPECT_FALSE(look(*scene, {-9.5, 0.5, -30}, {0, 1, 0}));
  const Bounds3& b = info->summary.bounds;
  EXPECT_NEAR(b.lo.x, -12, 1e-6);
  EXPECT_NEAR(b.hi.x, 11, 1e-6);
  EXPECT_NEAR(b.hi.z, 12, 1e-6);
}

TEST(Compile, NestedInstancesBecomeOneLevel) {
  const std::string inner = "ObjectBegin \"inner\" " + kTriangle + " ObjectEnd\n";
  const std::string outer =
      "ObjectBegin \"outer\" ObjectInstance \"inner\" Translate 0 0 1 ObjectInstance \"inner\" ObjectEnd\n";
  const auto [scene, info] =
      compiled_of(inner + outer + "ObjectInstance \"outer\" Translate 5 0 0 ObjectInstance \"outer\"\n");
  EXPECT_EQ(scene->geometry.groups.size(), 2u);
  EXPECT_EQ(scene->geometry.instances.size(), 2u);
  EXPECT_EQ(info->summary.triangles, 2u);  // both of "outer"
  EXPECT_EQ(info->summary.instanced_triangles, 4u);
  // An outer one that is used once dissolves, and leaves instances of the inner one.
  const auto [dissolved, dissolved_info] = compiled_of(inner + outer + "Translate 5 0 0 ObjectInstance \"outer\"\n");
  EXPECT_EQ(dissolved->geometry.instances.size(), 2u);
  EXPECT_EQ(dissolved_info->summary.triangles, 1u);
  EXPECT_EQ(dissolved_info->summary.instanced_triangles, 2u);
  const auto hit = look(*dissolved, {5.25, 0.25, 9}, {0, 0, -1});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->point.p.z + dissolved->origin.z, 1, 1e-5);
}

TEST(Compile, EmittersInObjectsBecomeLightsOfTheWorld) {
  const std::string lamp = "ObjectBegin \"lamp\" AttributeBegin " + kLight + kTriangle +
                           " AttributeEnd Translate 0 0 2 Shape \"sphere\" ObjectEnd\n";
  const std::string three =
      "AttributeBegin Translate 5 0 0 ObjectInstance \"x\" AttributeEnd\n"
      "AttributeBegin Translate 9 0 0 ObjectInstance \"x\" AttributeEnd ObjectInstance \"x\"\n";
  const std::string holder = "ObjectBegin \"x\" ObjectInstance \"lamp\" " + kTriangle + " ObjectEnd\n";
  const auto [scene, info] = compiled_of(lamp + holder + three);
  EXPECT_TRUE(scene->geometry.instances.empty());
  ASSERT_EQ(scene->lights.size(), 3u);
  EXPECT_EQ(info->summary.lights.at("diffuse area light"), 3u);
  std::vector<bool> met(3, false);
  for (const double x : {0.25, 5.25, 9.25})
    for (uint32_t light = 0; light < 3; ++light) {
      const auto s = scene->lights[light].sample_li(to_float(Point3d{x, 0.25, 1} - scene->origin), {0.5f, 0.5f}, {});
      ASSERT_TRUE(s);  // on the side of +z
      met[light] = true;
    }
  EXPECT_EQ(met, (std::vector<bool>{true, true, true}));
  for (const Light& light : scene->lights) EXPECT_FLOAT_EQ(light.power()[0], scene->lights[0].power()[0]);
  float all = 0;
  for (uint32_t light = 0; light < 3; ++light) all += scene->light_sampler.probability(light, nullptr);
  EXPECT_FLOAT_EQ(all, 1);
}

TEST(Compile, LightsOfMeshesFollowTheirTriangles) {
  const auto scene = scene_of(
      "Shape \"sphere\" " + kLight +
      "Shape \"trianglemesh\" \"point3 P\" [ 0 0 5  1 0 5  1 1 5  0.2 1 5 ] \"integer indices\" [ 0 1 2 0 2 3 ]\n"
      "Shape \"trianglemesh\" \"point3 P\" [ 2 0 5  3 0 5  3 1 5  2 1 5 ] \"integer indices\" [ 0 1 2 0 2 3 ]\n"
      "Translate 0 0 9 Shape \"sphere\" \"float radius\" 0.5");
  ASSERT_EQ(scene->lights.size(), 4u);  // the square is one
  const auto at = [&](double x, double y) { return look(*scene, {x, y, 6}, {0, 0, -1}); };
  const auto lower = at(0.75, 0.25), upper = at(0.3, 0.75), half = at(2.75, 0.25), other_half = at(2.25, 0.75);
  const auto ball = look(*scene, {0, 0, 20}, {0, 0, -1}), dark = look(*scene, {0, 0, -20}, {0, 0, 1});
  ASSERT_TRUE(lower && upper && half && other_half && ball && dark);
  EXPECT_NE(lower->light, upper->light);
  EXPECT_EQ(half->light, other_half->light);
  EXPECT_EQ(dark->light, kNoId);
  for (const auto& hit : {*lower, *upper, *half, *ball}) {
    ASSERT_LT(hit.light, 4u);
    EXPECT_EQ(scene->lights[hit.light].emitted(&hit.point, {0, 0, 1}, {})[0], 2.0f);
    EXPECT_EQ(scene->lights[hit.light].emitted(&hit.point, {0, 0, -1}, {})[0], 0.0f);
    EXPECT_GT(scene->lights[hit.light].pdf_li({0, 0, 30}, normalize(hit.point.p - Point3{0, 0, 30}), &hit.point, {}),
              0.0f);
  }
  EXPECT_FLOAT_EQ(scene->lights[ball->light].power()[0], 2 * kPi * kPi);
}

// A scene and the same scene far away have the same vertices after recentring.
TEST(Compile, FarScenesKeepTheirLocalGeometry) {
  const std::string object = "ObjectBegin \"o\" " + kTriangle + " ObjectEnd\n";
  const std::string local =
      "Shape \"trianglemesh\" \"point3 P\" [ 0.1 0.2 0.3  1.7 0.1 0  0 1.9 0.4 ] Translate 0.3 0.2 -1 "
      "Shape \"sphere\" \"float radius\" 0.1\n"
      "ObjectInstance \"o\" Translate 0 2 0 Rotate 30 1 2 3 ObjectInstance \"o\"\n";
  const auto here = scene_of(object + local);
  const auto there = scene_of(object + "Translate 1e6 -2e6 3e6\n" + local, "Translate -1e6 2e6 -3e6\n");
  EXPECT_NEAR(length(there->origin - here->origin - Vec3d{1e6, -2e6, 3e6}), 0, 1e-6);
  ASSERT_EQ(here->geometry.meshes.size(), there->geometry.meshes.size());
  for (size_t m = 0; m < here->geometry.meshes.size(); ++m)
    for (size_t i = 0; i < 3; ++i)
      EXPECT_LT(length(here->geometry.meshes[m].positions[i] - there->geometry.meshes[m].positions[i]), 1e-6f);
  EXPECT_LT(length(here->geometry.quadrics[0].to_world.t - there->geometry.quadrics[0].to_world.t), 1e-6);
  for (size_t i = 0; i < 2; ++i)
    EXPECT_LT(length(here->geometry.instances[i].to_world.t - there->geometry.instances[i].to_world.t), 1e-6f);
  const Point3 middle = there->geometry.meshes[0].positions[0];
  EXPECT_LT(std::abs(middle.x) + std::abs(middle.y) + std::abs(middle.z), 10.0f);
}

// ng of the triangle in the plane z = 0 (counterclockwise from +z), or of the sphere at its top, as seen from +z.
TEST(Compile, OrientationOfMeshesAndSpheres) {
  const std::string with_normals =
      "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1 0 ] \"normal N\" [ 0 0 -1  0 0 -1  0 0 -1 ] ";
  struct Case {
    const char* state;
    float plain, with_normals, sphere;
  };
  // Plain meshes: ReverseOrientation xor mirror. With normals: those (negated by ReverseOrientation), whatever the
  // winding; a mirror along x leaves their z. Spheres: ReverseOrientation alone.
  const Case cases[] = {{"", 1, -1, 1},
                        {"ReverseOrientation", -1, 1, -1},
                        {"Scale -1 1 1", 1, -1, 1},
                        {"ReverseOrientation Scale -1 1 1", -1, 1, -1},
                        {"Scale 1 1 -1", -1, 1, 1}};
  // The mirror along x turns the winding, which the rule turns back: ng stays +z. The one along z keeps the winding in
  // the plane, and the rule turns ng with the mirror.
  for (const Case& c : cases)
    for (const bool instanced : {false, true}) {
      const auto ng_z = [&](const std::string& shape) {
        const std::string use = std::string("AttributeBegin ") + c.state + " ";
        const std::string world = instanced ? "ObjectBegin \"o\" " + use + shape +
                                                  " AttributeEnd ObjectEnd ObjectInstance \"o\" Translate 50 0 0 "
                                                  "ObjectInstance \"o\""
                                            : use + shape + " AttributeEnd";
        const auto scene = scene_of(world);
        auto hit = look(*scene, {0.25, 0.25, 10}, {0, 0, -1});
        if (!hit) hit = look(*scene, {-0.25, 0.25, 10}, {0, 0, -1});
        EXPECT_TRUE(hit) << world;
        return hit ? hit->point.ng.z : 0.0f;
      };
      EXPECT_NEAR(ng_z(kTriangle), c.plain, 1e-6f) << c.state;
      EXPECT_NEAR(ng_z(with_normals), c.with_normals, 1e-6f) << c.state;
      EXPECT_GT(ng_z("Shape \"sphere\"") * c.sphere, 0.5f) << c.state;
    }
}

TEST(Compile, MirroredInstancesAreOrientedAsIfFlattened) {
  for (const char* mirror : {"Scale -1 1 1", "Scale 1 1 -1", "Scale -1 -1 -1"}) {
    const std::string object = "ObjectBegin \"o\" " + kTriangle + " ObjectEnd\n" + mirror + " ";
    const auto flat = scene_of(object + "ObjectInstance \"o\"");
    const auto shared = scene_of(object + "ObjectInstance \"o\" Translate 50 0 0 ObjectInstance \"o\"");
    int hits = 0;
    for (const double x : {-0.25, 0.25})
      for (const double y : {-0.25, 0.25}) {
        const auto a = look(*flat, {x, y, 10}, {0, 0, -1}), b = look(*shared, {x, y, 10}, {0, 0, -1});
        ASSERT_EQ(a.has_value(), b.has_value());
        if (!a) continue;
        ++hits;
        EXPECT_EQ(a->point.ng.z, b->point.ng.z) << mirror;
      }
    EXPECT_EQ(hits, 1);
  }
}

TEST(Compile, MaterialsAndTexturesReachTheSurface) {
  const auto [scene, info] = compiled_of(
      "Texture \"half\" \"float\" \"constant\" \"float value\" 0.5\n"
      "Texture \"t\" \"spectrum\" \"scale\" \"texture tex\" \"base\" \"texture scale\" \"half\"\n"
      "Texture \"base\" \"spectrum\" \"constant\" \"rgb value\" [ 1 0.5 0.25 ]\n"                      // after its use
      "Texture \"half\" \"spectrum\" \"scale\" \"texture tex\" \"base\" \"texture scale\" \"half\"\n"  // a name twice
      "Material \"diffuse\" \"texture reflectance\" \"half\"\n" +
      kTriangle);
  EXPECT_EQ(info->summary.textures.at("constant"), 2u);
  EXPECT_EQ(info->summary.textures.at("scale"), 2u);
  EXPECT_EQ(info->summary.materials.at("diffuse"), 1u);
  const auto hit = look(*scene, {0.25, 0.25, 10}, {0, 0, -1});
  ASSERT_TRUE(hit);
  const Spectrum albedo = hit->material->closure({hit->point.uv}, scene->textures, {}).albedo({0, 0, 1});
  EXPECT_EQ(albedo[0], 0.5f);
  EXPECT_EQ(albedo[2], 0.125f);
}

// Each line of a broken world with a part of the message that it must give; all of them at once.
TEST(Compile, EveryMistakeIsReportedTogether) {
  const TempFolder folder;
  const std::pair<std::string, std::string> mistakes[] = {
      {"Texture \"a\" \"spectrum\" \"scale\" \"texture tex\" \"b\"", "refers to itself"},
      {"Texture \"b\" \"spectrum\" \"scale\" \"texture tex\" \"a\"", ""},
      {"Texture \"c\" \"spectrum\" \"imagemap\" \"string filename\" \"no.png\"", "no.png"},
      {"Texture \"d\" \"spectrum\" \"checkerboard\" \"float uscael\" 2", "uscael"},
      {"Shape \"plymesh\" \"string filename\" \"no.ply\"", "no.ply"},
      {"Shape \"sphere\" \"float radius\" -1", "radius"},
      {"Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 nan 0 ]", ""},
      {"Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] \"integer indices\" [ 0 1 3 ]", "not a vertex"},
      {"AttributeBegin Scale 1 0 1 Shape \"sphere\" AttributeEnd", "singular"},
      {"AttributeBegin Material \"interface\" " + kLight + kTriangle + " AttributeEnd", "can't be an area light"},
      {"AttributeBegin AreaLightSource \"diffuse\" \"float scale\" -1 " + kTriangle + " AttributeEnd", "scale"},
      {"LightSource \"infinite\" \"float L2\" 1", "L2"},
      {"Material \"conductor\" \"rgb reflectance\" [ 1 1 1 ] \"rgb eta\" [ 1 1 1 ]", "reflectance"},
      {"Material \"diffuse\" \"rgb reflectance\" [ 1 1 ]", "reflectance"},
      {"ObjectBegin \"unused\" Shape \"sphere\" \"float radius\" 0 ObjectEnd", "radius"},
  };
  std::string world;
  for (const auto& [line, message] : mistakes) world += line + "\n";
  Diagnostics diagnostics;
  EXPECT_FALSE(compile_world(world, diagnostics, folder.path()).scene);
  const std::string all = diagnostics.format_all();
  int line = 2;
  for (const auto& [text, message] : mistakes) {
    ++line;
    if (message.empty()) continue;
    bool found = false;
    for (const Diagnostic& d : diagnostics.all())
      found = found ||
              (d.severity == Severity::kError && d.loc.line == line && d.message.find(message) != std::string::npos);
    EXPECT_TRUE(found) << text << "\n" << all;
  }
}

TEST(Compile, ALightWithoutAnAreaIsWorthAWarning) {
  Diagnostics diagnostics;
  EXPECT_TRUE(compile_world(
                  kLight + "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 0 0  2 0 0 ] \"integer indices\" [ 0 1 2 ]",
                  diagnostics)
                  .scene);
  ASSERT_EQ(diagnostics.all().size(), 1u);
  EXPECT_EQ(diagnostics.all()[0].severity, Severity::kWarning);
  EXPECT_EQ(diagnostics.all()[0].message, "an area light on a mesh without an area gives no light");
}

TEST(Compile, GeometryBeyondTheAcceleratorsReachIsAnError) {
  for (const std::string& world :
       {"Translate 1e19 0 0 " + kTriangle, std::string("Scale 1e30 1e30 1e30 Shape \"sphere\""),
        "ObjectBegin \"o\" " + kTriangle +
            " ObjectEnd ObjectInstance \"o\" Translate 0 -1e20 0 ObjectInstance \"o\""}) {
    Diagnostics diagnostics;
    EXPECT_FALSE(compile_world(world, diagnostics).scene);
    EXPECT_EQ(diagnostics.error_count(), 1) << world;
    EXPECT_NE(diagnostics.format_all().find("too far away"), std::string::npos);
  }
}

// Descriptions of other formats may hold what the pbrt reader stops itself.
TEST(Compile, SingularTransformsOfInstancesAndCamera) {
  SceneDescription d;
  d.camera.model = "perspective";
  d.filter.model = "box";
  d.objects.resize(1);
  d.instances.push_back({0, Transform::scale({1, 0, 1}), {}});
  d.camera_to_world = Transform::scale({0, 1, 1});
  Diagnostics diagnostics;
  EXPECT_FALSE(compile(d, {8, 8}, diagnostics).scene);
  EXPECT_EQ(diagnostics.error_count(), 2);
}

}  // namespace
}  // namespace etd
