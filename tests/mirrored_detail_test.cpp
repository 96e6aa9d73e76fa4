// Which way normal maps and bumps tilt, on every kind of shape and however uv, objects and orientations are mirrored.
// Where u and v grow is found by rays beside each other, not from what the shapes say of it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "formats/pbrt/reader.h"
#include "render_helper.h"
#include "scene/compile.h"
#include "scene/scene.h"
#include "temp_folder.h"
#include "textures/texture.h"

namespace etd {
namespace {

// A shape, and a ray of its own space that meets it where nothing is special.
struct Subject {
  std::string name, text;
  Point3d origin;
  Vec3d direction;
};

const std::vector<Subject>& subjects() {
  static const std::string square =
      "Shape \"trianglemesh\" \"point3 P\" [ -1 -1 0  1 -1 0.2  1 1 0.5  -1 1 0 ] \"integer indices\" [ 0 1 2 0 2 3 ] ";
  static const std::string smooth = "\"normal N\" [ 0.1 0 1  0 0.2 1  -0.1 0 1  0 0 1 ] ";
  static const std::string patch = "Shape \"bilinearmesh\" \"point3 P\" [ -1 -1 0  1 -1 0.2  -1 1 0  1 1 ";
  static const std::vector<Subject> all = {
      {"Triangles", square + "\"point2 uv\" [ 0 0  1 0  1 1  0 1 ]", {0.2, 0.3, 3}, {0.1, 0.05, -1}},
      {"TrianglesOfMirroredU", square + "\"point2 uv\" [ 1 0  0 0  0 1  1 1 ]", {0.2, 0.3, 3}, {0.1, 0.05, -1}},
      {"TrianglesOfMirroredV", square + "\"point2 uv\" [ 0 1  1 1  1 0  0 0 ]", {0.2, 0.3, 3}, {0.1, 0.05, -1}},
      {"TrianglesOfSkewedUV", square + "\"point2 uv\" [ 0 0  0.1 1  0.9 1.3  1 0 ]", {0.2, 0.3, 3}, {0.1, 0.05, -1}},
      {"TrianglesWithoutUV", square, {0.2, 0.3, 3}, {0.1, 0.05, -1}},
      {"SmoothTriangles", square + smooth + "\"point2 uv\" [ 0 0  1 0  1 1  0 1 ]", {0.2, 0.3, 3}, {0.1, 0.05, -1}},
      {"SmoothMirroredU", square + smooth + "\"point2 uv\" [ 1 0  0 0  0 1  1 1 ]", {0.2, 0.3, 3}, {0.1, 0.05, -1}},
      {"FlatPatch", patch + "0.2 ]", {0.2, 0.3, 3}, {0.1, 0.05, -1}},
      {"TwistedPatch", patch + "0.7 ]", {0.2, 0.3, 3}, {0.1, 0.05, -1}},
      {"PatchOfMirroredU", patch + "0.7 ] \"point2 uv\" [ 1 0  0 0  1 1  0 1 ]", {0.2, 0.3, 3}, {0.1, 0.05, -1}},
      {"Sphere", "Shape \"sphere\"", {3, 0.3, 0.4}, {-1, 0.05, 0.1}},
      {"Cylinder", "Shape \"cylinder\"", {3, 0.3, 0.4}, {-1, 0.05, 0.1}},
      {"Disk", "Shape \"disk\"", {0.2, 0.3, 3}, {0.1, 0.05, -1}}};
  return all;
}

struct Setting {
  std::string name;
  Transform to_world;
  bool reversed, instanced;
};

std::vector<Setting> settings() {
  const Transform turned = Transform::translate({3, -2, 1}) * Transform::rotate(40, {1, 2, 3});
  const Transform mirrored = turned * Transform::scale({-1, 1, 1}), flat = turned * Transform::scale({1, -0.5, 2});
  std::vector<Setting> all;
  for (const bool reversed : {false, true})
    for (const bool instanced : {false, true})
      for (const auto& [name, t] :
           {std::pair("Turned", turned), std::pair("Mirrored", mirrored), std::pair("MirroredAndStretched", flat)})
        all.push_back({std::string(name) + (reversed ? "Reversed" : "") + (instanced ? "Instanced" : ""), t, reversed,
                       instanced});
  return all;
}

std::string matrix(const Transform& t) {
  std::string text = "Transform [";
  for (size_t column = 0; column < 4; ++column)
    for (size_t row = 0; row < 4; ++row) text += fmt::format(" {:.17g}", t.matrix().m[row][column]);
  return text + " ]\n";
}

class MirroredDetail : public ::testing::TestWithParam<Subject> {
 protected:
  // The subject of this material alone in a world.
  std::shared_ptr<const Scene> scene_of(const Setting& s, const std::string& material) const {
    std::string shape = material + (s.reversed ? "ReverseOrientation\n" : "") + GetParam().text + "\n";
    // An object that is used twice becomes a group with a space of its own.
    std::string world = "WorldBegin\n";
    if (s.instanced)
      world += "ObjectBegin \"o\"\n" + shape + "ObjectEnd\n" + matrix(s.to_world) +
               "ObjectInstance \"o\"\nTranslate 9 0 0\nObjectInstance \"o\"\n";
    else
      world += matrix(s.to_world) + shape;
    Diagnostics diagnostics;
    auto scene = compile(read_pbrt_text(world, "test", folder_.path(), diagnostics), {16, 16}, diagnostics).scene;
    EXPECT_TRUE(scene) << diagnostics.format_all();
    return scene;
  }

  struct Look {
    SurfacePoint point;
    Frame frame;
  };
  // What a ray of the shape's own space meets, begun so far beside the subject's.
  Look look(const Scene& scene, const Setting& s, Vec3d beside = {}) const {
    const Vec3d d = s.to_world.vector(GetParam().direction);
    const Point3d o = s.to_world.point(GetParam().origin + beside) - scene.origin;
    Hit hit;
    EXPECT_TRUE(scene.intersect({to_float(o), to_float(d * (1 / length(d))), kInfinity, 0}, hit));
    const SurfaceHit surface = scene.surface(hit);
    HashStream rng(1);
    return {surface.point, scene.shade(surface, {}, rng).frame};
  }

  // The axes of growing u and v, at right angles to each other and to the shading normal, and the length of dp/dv along
  // the second.
  struct Axes {
    Vec3 u, v, n;
    float v_length;
  };
  Axes axes(const Scene& scene, const Setting& s) const {
    constexpr double kStep = 1e-3;
    const Look at = look(scene, s), a = look(scene, s, {0, kStep, 0}),
               b = look(scene, s, std::abs(GetParam().direction.x) < 0.5 ? Vec3d{kStep, 0, 0} : Vec3d{0, 0, kStep});
    const Vec3 p1 = a.point.p - at.point.p, p2 = b.point.p - at.point.p;
    const Vec2 w1{a.point.uv.x - at.point.uv.x, a.point.uv.y - at.point.uv.y},
        w2{b.point.uv.x - at.point.uv.x, b.point.uv.y - at.point.uv.y};
    const float inverse = 1.0f / (w1.x * w2.y - w2.x * w1.y);
    const Vec3 dpdu = (p1 * w2.y - p2 * w1.y) * inverse, dpdv = (p2 * w1.x - p1 * w2.x) * inverse;
    const Vec3 n = at.point.ns, u = normalize(dpdu - n * dot(n, dpdu));
    Vec3 v = cross(n, u);
    if (dot(v, dpdv) < 0) v = -v;
    return {u, v, n, dot(v, dpdv)};
  }

  static void expect_near(Vec3 a, Vec3 b) {
    EXPECT_LT(length(a - b), 5e-3f) << a.x << ' ' << a.y << ' ' << a.z << "; " << b.x << ' ' << b.y << ' ' << b.z;
  }
  static void expect_right_handed(const Frame& f) { EXPECT_NEAR(dot(cross(f.x, f.y), f.z), 1, 1e-5); }

  TempFolder folder_;
};

TEST_P(MirroredDetail, NormalMapsTiltTowardsGrowingUAndV) {
  const float texel[3] = {0.65f, 0.75f, 0.906155f};  // 0.3, 0.5 and 0.8123
  folder_.write("map.pfm", "PF\n1 1\n-1.0\n" + std::string(reinterpret_cast<const char*>(texel), sizeof texel));
  for (const Setting& s : settings()) {
    SCOPED_TRACE(s.name);
    const auto scene = scene_of(s, "Material \"diffuse\" \"string normalmap\" \"map.pfm\"\n");
    const Axes at = axes(*scene, s);
    const Frame frame = look(*scene, s).frame;
    expect_near(frame.z, normalize(at.u * 0.3f + at.v * 0.5f + at.n * 0.81231f));
    expect_right_handed(frame);
  }
}

TEST_P(MirroredDetail, BumpsLeanAwayFromWhatRises) {
  constexpr float kRise = 0.4f;  // from v = 0 to v = 1
  const std::string bumps = fmt::format(
      "Texture \"h\" \"float\" \"bilerp\" \"float v00\" 0 \"float v10\" 0 \"float v01\" "
      "{0} \"float v11\" {0}\nMaterial \"diffuse\" \"texture displacement\" \"h\"\n",
      kRise);
  for (const Setting& s : settings()) {
    SCOPED_TRACE(s.name);
    const auto scene = scene_of(s, bumps);
    const Axes at = axes(*scene, s);
    const Frame frame = look(*scene, s).frame;
    expect_near(frame.z, normalize(at.n - at.v * (kRise / at.v_length)));
    expect_right_handed(frame);
  }
}

// A brushed metal has two axes and no sign: mirrored, it scatters as before.
TEST_P(MirroredDetail, FramesWithoutDetailAreRightHandedAlongU) {
  for (const Setting& s : settings()) {
    SCOPED_TRACE(s.name);
    const auto scene = scene_of(s, "Material \"conductor\" \"float uroughness\" 0.4 \"float vroughness\" 0.05\n");
    const Axes at = axes(*scene, s);
    const Frame frame = look(*scene, s).frame;
    expect_near(frame.z, at.n);
    expect_near(frame.x, at.u);
    expect_right_handed(frame);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, MirroredDetail, ::testing::ValuesIn(subjects()),
                         [](const auto& subject) { return subject.param.name; });

}  // namespace
}  // namespace etd
