// Ray queries against brute force, and the geometry that can go wrong: nothing, no area, mirrors, padding.
#include <gtest/gtest.h>

#include "accel/accelerator.h"
#include "accel/spawn.h"
#include "accel/surface.h"
#include "accel_scenes.h"
#include "core/hash.h"
#include "core/warp.h"
#include "shapes/triangle.h"

namespace etd {
namespace {

// t of the nearest hit by testing everything in double, infinity when there is none.
double brute_force(const Geometry& g, uint32_t group, const Ray& r) {
  double best = r.t_max;
  const auto consider = [&](double t) {
    if (t > 0.0 && t < best) best = t;
  };
  const Point3d o = to_double(r.o);
  const Vec3d d = to_double(r.d);
  for (uint32_t m : g.groups[group].meshes) {
    const Mesh& mesh = g.meshes[m];
    for (const auto& index : mesh.triangles) {
      const Point3d p0 = to_double(mesh.positions[index[0]]);
      const Vec3d e1 = to_double(mesh.positions[index[1]]) - p0, e2 = to_double(mesh.positions[index[2]]) - p0;
      const double det = dot(cross(d, e2), e1);
      if (det == 0.0) continue;
      const double u = dot(cross(d, e2), o - p0) / det, v = dot(cross(o - p0, e1), d) / det;
      if (u >= 0.0 && v >= 0.0 && u + v <= 1.0) consider(dot(cross(o - p0, e1), e2) / det);
    }
  }
  for (uint32_t s = g.groups[group].quadric_begin; s < g.groups[group].quadric_end; ++s)
    if (const auto found = g.quadrics[s].intersect(r.o, r.d, r.t_max)) consider(found->t);
  if (group != 0) return best;
  for (const auto& instance : g.instances) {
    const Ray object{instance.to_object.point(r.o), instance.to_object.vector(r.d), r.t_max, 0};
    consider(brute_force(g, instance.group, object));
  }
  return best;
}

Vec3 random_vector(HashStream& h, float size) {
  const float x = h.next_float(), y = h.next_float(), z = h.next_float();
  return Vec3{x - 0.5f, y - 0.5f, z - 0.5f} * (2.0f * size);
}
Point3 random_point(HashStream& h, float size) { return Point3{} + random_vector(h, size); }

Geometry random_geometry(uint64_t seed) {
  HashStream h(seed);
  Geometry g;
  g.groups.resize(3);
  for (uint32_t group = 0; group < 3; ++group) {
    for (int m = 0; m < 2; ++m) {
      Mesh mesh;
      for (uint32_t i = 0; i < 15; ++i) {
        const Point3 p = random_point(h, 4);
        for (int k = 0; k < 3; ++k) mesh.positions.push_back(p + random_vector(h, 1));
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
      }
      g.groups[group].meshes.push_back(static_cast<uint32_t>(g.meshes.size()));
      g.meshes.push_back(std::move(mesh));
    }
    g.groups[group].quadric_begin = static_cast<uint32_t>(g.quadrics.size());
    for (int s = 0; s < 6; ++s) {
      const Vec3 at = random_vector(h, 4), axis = random_vector(h, 1), size = random_vector(h, 0.5f);
      g.quadrics.push_back(ellipsoid(Transform::translate(to_double(at)) * Transform::rotate(50, to_double(axis)) *
                                     Transform::scale(to_double(abs(size) + Vec3{0.1f, 0.1f, 0.1f}))));
    }
    g.groups[group].quadric_end = static_cast<uint32_t>(g.quadrics.size());
  }
  for (uint32_t i = 0; i < 4; ++i)
    g.instances.push_back(instance_of(1 + i % 2, Transform::translate(to_double(random_vector(h, 8))) *
                                                     Transform::rotate(70.0 * (i + 1), to_double(random_vector(h, 1))) *
                                                     Transform::scale({i == 3 ? -0.7 : 0.7, 1.2, 0.5 + i * 0.2})));
  return g;
}

TEST(Accel, AgreesWithBruteForce) {
  int hits = 0, disagreements = 0;
  for (uint64_t seed = 1; seed <= 4; ++seed) {
    const Geometry g = random_geometry(seed);
    const Accelerator accel(g);
    EXPECT_GT(accel.bytes(), 1000u);
    HashStream h(seed + 100);
    for (int i = 0; i < 20000; ++i) {
      Ray r{random_point(h, 12), random_vector(h, 1), kInfinity, 0};
      r.d = random_point(h, 5) - r.o;  // not of unit length
      if (i % 2) r.t_max = h.next_float();
      const double expected = brute_force(g, 0, r);
      const bool expect_hit = expected < r.t_max;
      Hit hit;
      const bool found = accel.intersect(r, hit);
      EXPECT_EQ(accel.occluded(r), found);
      EXPECT_EQ(found, hit.geometry != kNoId);
      // A ray may pass an edge or a silhouette on the other side of rounding.
      if (found != expect_hit || (found && std::abs(hit.t - expected) > 1e-4 * (1.0 + expected))) {
        ++disagreements;
        continue;
      }
      if (!found) continue;
      ++hits;
      ASSERT_LT(hit.t, r.t_max);
      const SurfacePoint s = surface_point(g, hit);
      EXPECT_LT(length(s.p - (r.o + r.d * hit.t)), 2e-4f * (1.0f + length(r.d)));
      EXPECT_NEAR(length(s.ng), 1.0f, 1e-5f);
      EXPECT_GT(s.p_error, 0.0f);
      EXPECT_LT(s.p_error, 1e-3f);
    }
  }
  EXPECT_GT(hits, 10000);
  EXPECT_LE(disagreements, 8);
}

TEST(Accel, NothingIsNeverHit) {
  Geometry g;
  g.groups.resize(2);
  g.meshes.resize(1);
  g.groups[0].meshes = {0};
  g.instances.push_back(instance_of(1, Transform::translate({1, 2, 3})));
  const Accelerator accel(g);
  Hit hit;
  EXPECT_FALSE(accel.intersect({{0, 0, 0}, {0, 0, 1}}, hit));
  EXPECT_FALSE(accel.occluded({{0, 0, 0}, {0, 0, 1}}));
  EXPECT_EQ(hit.geometry, kNoId);
}

TEST(Accel, AnInstanceOfTheWorldIsRefused) {
  Geometry g;
  g.instances.push_back(instance_of(0, Transform()));
  EXPECT_THROW(Accelerator{g}, std::runtime_error);
}

TEST(Accel, DegenerateTrianglesDoNoHarm) {
  Geometry g;
  Mesh m;
  m.positions = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  m.triangles = {{0, 1, 2}, {0, 0, 0}, {0, 3, 1}, {3, 4, 5}};
  g.meshes = {m};
  g.groups[0].meshes = {0};
  const Accelerator accel(g);
  Hit hit;
  EXPECT_TRUE(accel.intersect({{0.25f, 0.25f, 3}, {0, 0, -1}}, hit));
  EXPECT_EQ(hit.primitive, 3u);
  EXPECT_NEAR(hit.t, 3.0f, 1e-6f);  // processors differ in how they divide
  for (uint32_t i = 0; i < 3; ++i) {
    EXPECT_EQ(triangle_area(m, i), 0.0f);
    const SurfacePoint s = triangle_point(m, i, 0.3f, 0.3f);
    EXPECT_TRUE(is_finite(s.p - Point3{}) && is_finite(s.ng) && is_finite(s.dpdu) && std::isfinite(s.p_error));
  }
}

TEST(Accel, VertexBuffersNeedNoSpareCapacity) {
  for (const bool spare : {false, true}) {
    Geometry g;
    Mesh m;
    m.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    m.positions.shrink_to_fit();
    if (spare) m.positions.reserve(4);
    m.triangles = {{0, 1, 2}};
    g.meshes.push_back(std::move(m));
    g.groups[0].meshes = {0};
    const Accelerator accel(g);
    EXPECT_TRUE(accel.occluded({{0.25f, 0.25f, 3}, {0, 0, -1}}));
    EXPECT_FALSE(accel.occluded({{0.25f, 0.25f, 3}, {0, 0, -1}, 3.0f - 1e-6f}));
    EXPECT_TRUE(accel.occluded({{0.25f, 0.25f, 3}, {0, 0, -1}, 3.0f + 1e-6f}));
  }
}

}  // namespace
}  // namespace etd
