// Bumps and normal maps against slopes that are known.
#include "materials/surface_detail.h"

#include <gtest/gtest.h>

#include "shapes/mesh.h"
#include "shapes/triangle.h"
#include "textures/texture_list.h"

namespace etd {
namespace {

// A triangle in a generic position, whose uvs stretch and skew.
Mesh skewed(bool flip) {
  Mesh mesh;
  mesh.positions = {{1, 2, 3}, {4, 2.5f, 3}, {1.5f, 5, 4}, {0, 0, 0}};
  mesh.uvs = {{0.1f, 0.2f}, {0.8f, 0.3f}, {0.2f, 0.9f}};
  mesh.triangles = {{0, 1, 2}};
  mesh.flip_ng = flip;
  return mesh;
}

// A texture that rises from 0 to 1 along u, or down the rows, with 64 texels.
int32_t add_ramp(TextureTable& table, bool along_u) {
  std::vector<float> values;
  for (int i = 0; i < 64; ++i) values.push_back((static_cast<float>(i) + 0.5f) / 64.0f);
  ImageMapTexture t;
  t.image = static_cast<int32_t>(table.images.size());
  table.images.emplace_back(std::make_shared<const Image>(along_u ? Image(64, 1, 1, values) : Image(1, 64, 1, values)));
  table.textures.push_back(Texture(t));
  return static_cast<int32_t>(table.textures.size()) - 1;
}

void expect_near(Vec3 a, Vec3 b, float tolerance) {
  EXPECT_LT(length(a - b), tolerance) << a.x << ' ' << a.y << ' ' << a.z << "; " << b.x << ' ' << b.y << ' ' << b.z;
}

// The displaced triangle is flat again: its normal comes from its displaced corners.
TEST(SurfaceDetail, BumpsTiltThePlaneThatTheyMake) {
  TextureTable table;
  for (const bool along_u : {true, false}) {
    SurfaceDetail detail;
    detail.displacement = {0, add_ramp(table, along_u)};
    for (const bool flip : {false, true}) {
      const Mesh mesh = skewed(flip);
      const SurfacePoint s = triangle_point(mesh, 0, 0.3f, 0.3f);
      Point3 p[3];
      for (size_t i = 0; i < 3; ++i) {
        const float height = along_u ? mesh.uvs[i].x : 1.0f - mesh.uvs[i].y;
        p[i] = mesh.positions[i] + s.ns * height;
      }
      const Vec3 expected = normalize(face_forward(cross(p[1] - p[0], p[2] - p[0]), s.ng));
      expect_near(detail.frame(s, {s.uv}, table, {}).z, expected, 2e-3f);
    }
  }
}

TEST(SurfaceDetail, ConstantHeightChangesNothing) {
  TextureTable table;
  const SurfacePoint s = triangle_point(skewed(false), 0, 0.3f, 0.3f);
  SurfaceDetail detail;
  detail.displacement = {3.0f, -1};
  expect_near(detail.frame(s, {s.uv}, table, {}).z, s.ns, 1e-6f);
}

TEST(SurfaceDetail, NormalMapsAreInTheFrameOfU) {
  TextureTable table;
  table.images.emplace_back(std::make_shared<const Image>(1, 1, 3, std::vector<float>{0.8f, 0.5f, 0.9f}));
  ImageMapTexture t;
  t.image = 0;
  table.textures.push_back(Texture(t));
  SurfaceDetail detail;
  detail.normal_map = 0;
  const SurfacePoint s = triangle_point(skewed(false), 0, 0.3f, 0.3f);
  const Frame plain = Frame::from_z_tangent(s.ns, s.dpdu);
  expect_near(detail.frame(s, {s.uv}, table, {}).z, normalize(plain.x * 0.6f + s.ns * 0.8f), 1e-5f);
}

}  // namespace
}  // namespace etd
