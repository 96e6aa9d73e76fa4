// Bilinear patches: every point of them is met, and nothing else; parametrisation, sampling, closed bodies of patches.
#include "shapes/patch.h"

#include <gtest/gtest.h>

#include "accel/accelerator.h"
#include "accel/spawn.h"
#include "accel/surface.h"
#include "accel_scenes.h"
#include "core/frame.h"
#include "core/hash.h"
#include "core/warp.h"
#include "shapes/mesh_shapes.h"

namespace etd {
namespace {

Vec2 uniform(HashStream& h) {
  const float x = h.next_float();
  return {x, h.next_float()};
}

PatchMesh one_patch(Point3 a, Point3 b, Point3 c, Point3 d) {
  PatchMesh m;
  m.positions = {a, b, c, d};
  m.patches = {{0, 1, 2, 3}};
  return m;
}

std::vector<PatchMesh> examples() {
  return {one_patch({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}),                           // square
          one_patch({-1, 0, 0.5f}, {1, 0.2f, -0.5f}, {-1, 1.5f, -0.7f}, {1.2f, 1, 0.8f}),  // saddle
          one_patch({0, 0, 0}, {0, 0, 0}, {1, 0, 0.2f}, {0, 1, 0}),                        // triangle
          one_patch({-1, -1, 0}, {1, -1, 0}, {-0.2f, 1, 0}, {0.3f, 1, 0}),                 // trapezoid
          one_patch({100, 100, 100}, {101, 100, 100.4f}, {100, 101, 99.7f}, {101, 101.5f, 100})};
}

Point3 at(const PatchMesh& m, Vec2 uv) {
  const auto& p = m.positions;
  const Point3 a = p[0] + (p[1] - p[0]) * uv.x, b = p[2] + (p[3] - p[2]) * uv.x;
  return a + (b - a) * uv.y;
}

TEST(Patch, IsMetWhereItIs) {
  HashStream h(1);
  for (const PatchMesh& m : examples()) {
    int missed = 0;
    for (int i = 0; i < 20000; ++i) {
      const Point3 target = at(m, uniform(h));
      const Point3 o = target + sample_sphere_uniform(uniform(h)) * (0.1f + 3 * h.next_float());
      const auto found = intersect_patch(m, 0, o, target - o, kInfinity);
      if (!found || found->t > 1.001f) {
        ++missed;
        continue;
      }
      // What was found lies on ray and patch.
      ASSERT_LT(length(o + (target - o) * found->t - at(m, {found->u, found->v})), 1e-4f);
      ASSERT_FALSE(intersect_patch(m, 0, o, target - o, found->t));
      const auto second = intersect_patch(m, 0, o, target - o, kInfinity, found->t);
      ASSERT_TRUE(!second || second->t > found->t);
    }
    EXPECT_LE(missed, 100);  // targets are rounded, which matters where the ray grazes the patch and at its edges
  }
  const PatchMesh saddle = examples()[1];
  int twice = 0;
  for (int i = 0; i < 2000; ++i) {
    const Point3 a = at(saddle, uniform(h)), b = at(saddle, uniform(h)), o = a + (a - b);
    const auto first = intersect_patch(saddle, 0, o, b - a, kInfinity);
    twice += first && intersect_patch(saddle, 0, o, b - a, kInfinity, first->t).has_value();
  }
  EXPECT_GT(twice, 1900);
}

TEST(Patch, MissesBeyondItsEdges) {
  HashStream h(2);
  for (const PatchMesh& m : examples())
    for (int i = 0; i < 5000; ++i) {
      Vec2 uv = uniform(h);
      (i & 1 ? uv.x : uv.y) = i & 2 ? 1.001f + h.next_float() : -0.001f - h.next_float();
      const Point3 target = at(m, uv), o = target + sample_sphere_uniform(uniform(h));
      const auto found = intersect_patch(m, 0, o, target - o, kInfinity);
      ASSERT_TRUE(!found || std::abs(found->t - 1) > 1e-5f) << uv.x << ' ' << uv.y;
    }
}

TEST(Patch, ParametrisationFollowsUvs) {
  HashStream h(3);
  for (PatchMesh m : examples()) {
    for (const bool own : {false, true}) {
      m.uvs.clear();
      if (own) m.uvs = {{0.1f, 0.2f}, {0.9f, 0.1f}, {0.2f, 1}, {1.1f, 1.3f}};
      for (int i = 0; i < 200; ++i) {
        const Vec2 uv{0.05f + 0.9f * h.next_float(), 0.05f + 0.9f * h.next_float()};
        const float e = 1e-2f;
        const SurfacePoint s = patch_point(m, 0, uv.x, uv.y);
        const SurfacePoint right = patch_point(m, 0, uv.x + e, uv.y), up = patch_point(m, 0, uv.x, uv.y + e);
        EXPECT_EQ(s.parameters, uv);
        // Along both parameters p moves as dpds ds + dpdt dt; without own uvs dpdt is not needed along u.
        if (!own) {
          EXPECT_EQ(s.uv, uv);
          EXPECT_LT(length((right.p - s.p) * (1 / e) - s.dpdu), 1e-2f);
        } else {
          const Vec2 du{right.uv.x - s.uv.x, right.uv.y - s.uv.y}, dv{up.uv.x - s.uv.x, up.uv.y - s.uv.y};
          const float det = du.x * dv.y - dv.x * du.y;
          const Vec3 dpds = ((right.p - s.p) * dv.y - (up.p - s.p) * du.y) * (1 / det);
          EXPECT_LT(length(dpds - s.dpdu), 0.05f * (1 + length(dpds)));
        }
        EXPECT_NEAR(dot(s.ng, s.dpdu), 0, 1e-4f * (1 + length(s.dpdu)));
        EXPECT_NEAR(length(s.ng), 1, 1e-5f);
      }
    }
  }
  PatchMesh square = examples()[0];
  EXPECT_EQ(patch_point(square, 0, 0.3f, 0.4f).ng, (Vec3{0, 0, 1}));
  square.flip_ng = true;
  EXPECT_EQ(patch_point(square, 0, 0.3f, 0.4f).ng, (Vec3{0, 0, -1}));
  square.normals.assign(4, normalize(Vec3{1, 0, 1}));
  EXPECT_EQ(patch_point(square, 0, 0.3f, 0.4f).ng, (Vec3{0, 0, 1}));
  EXPECT_GT(patch_point(square, 0, 0.3f, 0.4f).ns.x, 0.7f);
}

TEST(Patch, AreasAndDensitiesBelongTogether) {
  HashStream h(4);
  EXPECT_NEAR(patch_area(examples()[0], 0), 1, 1e-6f);
  EXPECT_NEAR(patch_area(examples()[3], 0), 2.5f, 1e-4f);
  for (const PatchMesh& m : examples()) {
    double area = 0;
    constexpr int kSamples = 40000;
    for (int i = 0; i < kSamples; ++i) {
      const SurfacePoint s = sample_patch(m, 0, uniform(h));
      area += 1.0 / static_cast<double>(patch_pdf_area(m, 0, s.parameters)) / kSamples;
    }
    EXPECT_NEAR(area / patch_area(m, 0), 1, 0.01);
  }
}

// A cube with its corners pulled about, all normals inwards: twisted patches that share edges, and, from the patch
// `triangles_from` on, two triangles in the place of each.
Geometry twisted_box(const Transform& t, size_t triangles_from = 6) {
  Geometry g;
  PatchMesh m;
  const Vec3d pulls[8] = {{0, -.2, 0}, {0, 0, .2},   {-.1, 0, -.3}, {.4, -.1, 0},
                          {.2, 0, .1}, {.2, -.3, 0}, {0, .1, -.1},  {-.1, .2, .3}};
  for (int i = 0; i < 8; ++i)
    m.positions.push_back(
        to_float(t.point(Point3d{i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0} + pulls[i])));
  m.patches = {{0, 1, 2, 3}, {4, 6, 5, 7}, {0, 4, 1, 5}, {2, 3, 6, 7}, {0, 2, 4, 6}, {1, 5, 3, 7}};
  m.flip_ng = t.determinant3() < 0;
  Mesh triangles;
  triangles.positions = m.positions;
  triangles.flip_ng = m.flip_ng;
  for (size_t i = triangles_from; i < m.patches.size(); ++i) {
    const auto& p = m.patches[i];
    triangles.triangles.push_back({p[0], p[1], p[3]});
    triangles.triangles.push_back({p[0], p[3], p[2]});
  }
  m.patches.resize(triangles_from);
  if (!triangles.triangles.empty()) {
    g.meshes.push_back(std::move(triangles));
    g.groups[0].meshes = {0};
  }
  g.patch_meshes.push_back(std::move(m));
  g.groups[0].patch_meshes = {0};
  return g;
}

uint64_t escapes(const Geometry& g, Point3 centre, uint64_t bounces) {
  const Accelerator accel(g);
  HashStream h(1);
  uint64_t escaped = 0;
  Ray ray{centre, sample_sphere_uniform(uniform(h))};
  for (uint64_t i = 0; i < bounces; ++i) {
    Hit hit;
    bool lost = !accel.intersect(ray, hit);
    if (!lost) {
      const SurfacePoint s = surface_point(g, hit);
      lost = dot(normalize(ray.d), s.ng) > 1e-3f;
      Vec3 w;
      do {
        w = Frame::from_z(s.ng).to_world(sample_hemisphere_cosine(uniform(h)));
      } while (!(dot(w, s.ng) > 0.0f));
      ray = spawn_ray(s, w);
    }
    if (lost) ray = {centre, sample_sphere_uniform(uniform(h))}, ++escaped;
  }
  return escaped;
}

void closed_boxes(uint64_t bounces) {
  for (const double scale : {1e-3, 1.0, 1e5})
    for (const double sizes : {0.0, 100.0}) {
      const Transform t = Transform::translate({1.3 * sizes * scale, -0.7 * sizes * scale, sizes * scale}) *
                          generic_rotation() * Transform::scale({scale, 0.8 * scale, -scale});
      for (const size_t patches : {6u, 3u})
        EXPECT_EQ(escapes(twisted_box(t, patches), to_float(t.point({0, 0, 0})), bounces), 0u)
            << scale << ' ' << sizes << ' ' << patches;
    }
  // The same through an instance, off the origin of its own space.
  Geometry g = twisted_box(Transform::translate({50, -30, 10}));
  g.groups.push_back(std::move(g.groups[0]));
  g.groups[0] = {};
  g.instances.push_back(instance_of(1, Transform::translate({7, 8, 9}) * generic_rotation() *
                                           Transform::scale({1, 0.5, 2}) * Transform::translate({-50, 30, -10})));
  EXPECT_EQ(escapes(g, {7, 8, 9}, bounces), 0u);
}

TEST(PatchLeak, ClosedBoxesAreTight) { closed_boxes(200000); }
TEST(SlowPatchLeak, ClosedBoxesAreTight) { closed_boxes(10000000); }

TEST(PatchShapes, ParallelogramsBecomeTriangles) {
  PatchData data;
  data.vertices.positions = {{0, 0, 0}, {2, 0, 0}, {1, 1, 1}, {3, 1, 1}, {9, 9, 9}};
  data.patches = {{0, 1, 2, 3}};
  const auto mesh = as_triangles(data);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->triangles, (std::vector<std::array<uint32_t, 3>>{{0, 1, 3}, {0, 3, 2}}));
  EXPECT_EQ(mesh->uvs, (std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}, {1, 1}}));
  data.vertices.uvs = {{0, 0}, {1, 0}, {0, 1}, {1, 2}, {0, 0}};
  EXPECT_FALSE(as_triangles(data));
  data.vertices.uvs.clear();
  data.vertices.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 1, 1}, {0, 0, 1}};
  EXPECT_FALSE(as_triangles(data));
  data.vertices.normals.clear();
  data.patches = {{0, 1, 2, 4}};
  EXPECT_FALSE(as_triangles(data));
}

}  // namespace
}  // namespace etd
