// Points, normals, parametrisations and areas of triangles and spheres; instances against flattened geometry.
#include <gtest/gtest.h>

#include "accel/surface.h"
#include "accel_scenes.h"
#include "core/hash.h"
#include "core/warp.h"
#include "shapes/triangle.h"

namespace etd {
namespace {

// Centre of cell i of n in [0, 1).
float cell(int i, int n) { return (static_cast<float>(i) + 0.5f) / static_cast<float>(n); }

void expect_near(Vec3 a, Vec3 b, float tolerance) {
  EXPECT_LT(length(a - b), tolerance) << a.x << ' ' << a.y << ' ' << a.z;
}

Mesh one_triangle() {
  Mesh m;
  m.positions = {{1, 0, 0}, {3, 0, 0}, {1, 1, 0}};
  m.triangles = {{0, 1, 2}};
  return m;
}

// What is kept of a face is what would be found for each point.
TEST(Triangle, PreparedFacesChangeNoBit) {
  HashStream rng(2);
  const auto number = [&] { return 4.0f * rng.next_float() - 2.0f; };
  for (int i = 0; i < 1000; ++i) {
    Mesh m;
    for (int k = 0; k < 3; ++k) m.positions.push_back({number(), number(), number()});
    if (i % 10 == 0) m.positions[2] = m.positions[1];
    m.triangles = {{0, 1, 2}};
    m.flip_ng = i % 2 == 0;
    const float u = rng.next_float(), v = rng.next_float() * (1.0f - u);
    const SurfacePoint a = triangle_point(m, 0, u, v);
    prepare_faces(m);
    const SurfacePoint b = triangle_point(m, 0, u, v);
    EXPECT_EQ(a.p, b.p);
    EXPECT_EQ(a.ng, b.ng);
    EXPECT_EQ(a.p_error, b.p_error);
  }
}

TEST(Triangle, PointNormalAndDefaultUv) {
  Mesh m = one_triangle();
  SurfacePoint s = triangle_point(m, 0, 0.25f, 0.5f);
  expect_near(s.p - Point3{1.5f, 0.5f, 0}, {}, 1e-6f);
  expect_near(s.ng, {0, 0, 1}, 1e-6f);
  EXPECT_NEAR(s.uv.x, 0.75f, 1e-6f);
  EXPECT_NEAR(s.uv.y, 0.5f, 1e-6f);
  expect_near(s.dpdu, {2, 0, 0}, 1e-6f);
  EXPECT_FLOAT_EQ(triangle_area(m, 0), 1.0f);
  m.flip_ng = true;
  s = triangle_point(m, 0, 0.25f, 0.5f);
  expect_near(s.ng, {0, 0, -1}, 1e-6f);
  EXPECT_EQ(s.ns, s.ng);
}

TEST(Triangle, NgTurnsToTheSideOfVertexNormals) {
  Mesh m = one_triangle();
  m.normals = {normalize(Vec3{1, 0, -1}), {0, 0, -1}, {0, 0, -1}};
  m.flip_ng = false;
  SurfacePoint s = triangle_point(m, 0, 0.25f, 0.25f);
  expect_near(s.ng, {0, 0, -1}, 1e-6f);
  EXPECT_GT(s.ns.x, 0.1f);
  EXPECT_NEAR(length(s.ns), 1.0f, 1e-6f);
  m.normals = {{}, {}, {}};
  s = triangle_point(m, 0, 0.25f, 0.25f);
  expect_near(s.ns, {0, 0, 1}, 1e-6f);  // zero normals stand for the face's
}

TEST(Triangle, DpduFollowsTheUvs) {
  Mesh m = one_triangle();
  m.uvs = {{0, 0}, {0, 2}, {4, 0}};  // u along y: 4 per 1, v along x: 2 per 2
  SurfacePoint s = triangle_point(m, 0, 0.5f, 0.25f);
  expect_near(s.dpdu, {0, 0.25f, 0}, 1e-6f);
  EXPECT_NEAR(s.uv.x, 1.0f, 1e-6f);
  EXPECT_NEAR(s.uv.y, 1.0f, 1e-6f);
  m.uvs = {{1, 1}, {1, 1}, {1, 1}};
  s = triangle_point(m, 0, 0.5f, 0.25f);
  expect_near(s.dpdu, {2, 0, 0}, 1e-6f);
}

TEST(Triangle, StaysOffItsEdges) {
  const Mesh m = one_triangle();
  for (const Vec2 b : {Vec2{0, 0}, Vec2{1, 0}, Vec2{0, 1}, Vec2{-1e-7f, 0.5f}, Vec2{0.5f, 0.5f}}) {
    const SurfacePoint s = triangle_point(m, 0, b.x, b.y);
    EXPECT_GT(s.p.y, 0x1p-21f);
    EXPECT_GT(s.p.x, 1.0f);
    EXPECT_LT((s.p.x - 1.0f) / 2 + s.p.y, 1.0f);
  }
}

TEST(Triangle, SamplesAreUniform) {
  const Mesh m = one_triangle();
  Vec3d mean;
  constexpr int kSide = 300;
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) {
      const SurfacePoint s = sample_triangle(m, 0, {cell(i, kSide), cell(j, kSide)});
      mean += to_double(s.p - Point3{}) * (1.0 / (kSide * kSide));
    }
  EXPECT_NEAR(mean.x, 5.0 / 3.0, 1e-3);
  EXPECT_NEAR(mean.y, 1.0 / 3.0, 1e-3);
}

TEST(Sphere, PointUvAndDpdu) {
  const Quadric sphere = ellipsoid(Transform::translate({1, 2, 3}) * Transform::scale({2, 2, 2}));
  SurfacePoint s = quadric_point(sphere, {0, 1, 0});
  expect_near(s.p - Point3{1, 4, 3}, {}, 1e-6f);
  expect_near(s.ng, {0, 1, 0}, 1e-6f);
  EXPECT_NEAR(s.uv.x, 0.25f, 1e-6f);
  EXPECT_NEAR(s.uv.y, 0.5f, 1e-6f);
  expect_near(s.dpdu, {-4 * kPi, 0, 0}, 1e-5f);
  EXPECT_NEAR(quadric_point(sphere, {0, 0, 1}).uv.y, 1.0f, 1e-6f);
  EXPECT_NEAR(quadric_point(sphere, {0, 0, -1}).uv.y, 0.0f, 1e-6f);
  EXPECT_NEAR(quadric_point(sphere, normalize(Vec3d{1, -1, 0})).uv.x, 0.875f, 1e-6f);
}

TEST(Sphere, AnEllipsoidsNormalIsThatOfItsQuadric) {
  Quadric sphere = ellipsoid(Transform::scale({3, 1, -1}));
  const Vec3d n = normalize(Vec3d{1, 1, 0});
  const Vec3 expected = to_float(normalize(Vec3d{n.x / 3, n.y, 0}));
  expect_near(quadric_point(sphere, n).ng, expected, 1e-6f);
  sphere.flip_ng = true;
  expect_near(quadric_point(sphere, n).ng, -expected, 1e-6f);
}

TEST(Sphere, FarTinyAndTouchedSpheres) {
  const Quadric tiny = ellipsoid(Transform::translate({0, 0, 1e5}) * Transform::scale({1e-3, 1e-3, 1e-3}));
  const auto found = tiny.intersect({0, 0, 0}, {0, 0, 1}, kInfinity);
  ASSERT_TRUE(found);
  expect_near(to_float(tiny.unit_point_at(found->offset)), {0, 0, -1}, 1e-5f);
  EXPECT_FALSE(tiny.intersect({0.0011f, 0, 0}, {0, 0, 1}, kInfinity));
  EXPECT_TRUE(tiny.intersect({0.0009f, 0, 0}, {0, 0, 1}, kInfinity));
  const Quadric unit = ellipsoid(Transform());
  EXPECT_FALSE(unit.intersect({0, 0, 1}, {0, 0, 2}, kInfinity));         // on the surface, leaving
  EXPECT_EQ(unit.intersect({0, 0, 1}, {0, 0, -2}, kInfinity)->t, 1.0f);  // on it, crossing
  EXPECT_EQ(unit.intersect({0, 0, 0.5f}, {0, 0, 0.25f}, kInfinity)->t, 2.0f);
  EXPECT_FALSE(unit.intersect({0, 0, 3}, {0, 0, -1}, 2.0f));  // the end is open
  EXPECT_FALSE(unit.intersect({0, 0, 3}, {0, 0, 0}, kInfinity));
}

TEST(Sphere, AreaIsTheIntegralOfItsStretch) {
  const Vec3d axes[] = {{2, 2, 2}, {3, 2, 1}, {1, 1, 0.5}, {1, 2, 2}, {1, 1.0001, 1}, {5, 0.5, 0.6}, {1, 1, 0.02}};
  for (const Vec3d& a : axes) {
    const Quadric s = ellipsoid(generic_rotation() * Transform::scale(a) * Transform::rotate(20, {1, 2, 3}));
    double sum = 0;
    constexpr int kZ = 1000, kPhi = 200;
    for (int i = 0; i < kZ; ++i)
      for (int j = 0; j < kPhi; ++j)
        sum += quadric_area_stretch(s, to_double(sample_sphere_uniform({cell(i, kZ), cell(j, kPhi)})));
    const double area = sum * 4.0 * M_PI / (kZ * kPhi);
    EXPECT_NEAR(quadric_area(s) / area, 1.0, 2e-4) << a.x << ' ' << a.y << ' ' << a.z;
    Vec3d n;
    sample_quadric(s, {0.3f, 0.8f}, &n);
    EXPECT_NEAR(quadric_pdf_area(s, n) * 4 * kPi * quadric_area_stretch(s, n), 1.0f, 1e-5f);
  }
  EXPECT_NEAR(quadric_area(ellipsoid(Transform::scale({2, 2, 2}))), 16 * kPi, 1e-4f);
  EXPECT_NEAR(quadric_area(ellipsoid(Transform::scale({1, 1, 1e-4}))), 2 * kPi, 1e-4f);  // two sides of a disk
}

TEST(Surface, InstancesAreWhatFlatteningWouldGive) {
  HashStream h(3);
  for (const bool mirrored : {false, true})
    for (const bool with_normals : {false, true}) {
      const Transform t = Transform::translate({3, -4, 5}) * Transform::rotate(40, {1, 2, 3}) *
                          Transform::scale({1.3, mirrored ? -0.8 : 0.8, 1.1});
      Mesh object = box_mesh(generic_rotation());
      if (with_normals)
        for (const Point3& p : object.positions) object.normals.push_back(normalize(p - Point3{}));
      Mesh flat = object;
      for (Point3& p : flat.positions) p = to_float(t.point(to_double(p)));
      for (Vec3& n : flat.normals) n = normalize(to_float(t.normal(to_double(n))));
      flat.flip_ng = mirrored;
      const GeometryInstance instance = instance_of(1, t);
      for (uint32_t i = 0; i < 12; ++i) {
        const float b1 = 0.5f * h.next_float(), b2 = 0.5f * h.next_float();
        const SurfacePoint a = to_world(triangle_point(object, i, b1, b2), instance);
        const SurfacePoint b = triangle_point(flat, i, b1, b2);
        expect_near(a.p - b.p, {}, 1e-5f);
        expect_near(a.ng, b.ng, 1e-5f);
        expect_near(a.dpdu, b.dpdu, 1e-5f);
        EXPECT_GT(dot(a.ng, a.ns), 0.0f);
        if (!with_normals) expect_near(a.ns, b.ns, 1e-5f);
        EXPECT_GE(a.p_error, 0.5f * b.p_error);
        EXPECT_LT(a.p_error, 100.0f * b.p_error);
      }
    }
}

TEST(Surface, OffsetOriginsNeverRoundBack) {
  HashStream h(5);
  for (int i = 0; i < 10000; ++i) {
    SurfacePoint s;
    s.p = {1000.0f * h.next_float(), 1e-3f * h.next_float(), -h.next_float()};
    s.ng = s.ns = sample_sphere_uniform({h.next_float(), h.next_float()});
    s.p_error = 1e-7f * h.next_float();
    const Vec3d moved = to_double(offset_origin(s, s.ng)) - to_double(s.p);
    EXPECT_GE(dot(moved, to_double(s.ng)), 0.999999 * s.p_error);
    const Vec3d back = to_double(offset_origin(s, -s.ng)) - to_double(s.p);
    EXPECT_LE(dot(back, to_double(s.ng)), -0.999999 * s.p_error);
  }
}

}  // namespace
}  // namespace etd
