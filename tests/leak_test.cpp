// Rays must neither leave closed geometry nor meet the surface they start on, at any scale and off the origin.
// The SlowLeak suite does the same with 10^8 bounces a case.
#include <gtest/gtest.h>

#include "accel/accelerator.h"
#include "accel/spawn.h"
#include "accel/surface.h"
#include "accel_scenes.h"
#include "core/frame.h"
#include "core/hash.h"
#include "core/warp.h"
#include "shapes/triangle.h"

namespace etd {
namespace {

constexpr uint64_t kFast = 1000000, kSlow = 100000000;

// Rays from surface to surface that got where they cannot be.
struct Leaks {
  uint64_t escaped = 0;     // met nothing
  uint64_t wrong_side = 0;  // met a surface from behind its ng
};

Vec2 uniform(HashStream& h) {
  const float x = h.next_float();
  return {x, h.next_float()};
}

// Directions that rounding has put into the plane belong to neither side: an estimator drops them (their pdf is 0).
Vec3 cosine_direction(Vec3 n, HashStream& h) {
  for (;;) {
    const Vec3 w = Frame::from_z(n).to_world(sample_hemisphere_cosine(uniform(h)));
    if (dot(w, n) > 0.0f) return w;
  }
}

// Follows cosine-distributed bounces from `start`. Every ng of the geometry points into the closed space.
Leaks follow_bounces(const Geometry& g, Point3 start, uint64_t bounces, uint64_t seed = 1) {
  const Accelerator accel(g);
  HashStream h(seed);
  Leaks leaks;
  Ray ray{start, sample_sphere_uniform(uniform(h))};
  for (uint64_t i = 0; i < bounces; ++i) {
    Hit hit;
    bool lost = !accel.intersect(ray, hit);
    leaks.escaped += lost;
    if (!lost) {
      const SurfacePoint s = surface_point(g, hit);
      const Vec3 d = normalize(ray.d);
      if (dot(d, s.ng) > 1e-4f) lost = true, ++leaks.wrong_side;
      ray = spawn_ray(s, cosine_direction(s.ng, h));
    }
    if (lost) ray = {start, sample_sphere_uniform(uniform(h))};
  }
  return leaks;
}

void expect_tight(const Geometry& g, Point3 start, uint64_t bounces, const char* what) {
  const Leaks leaks = follow_bounces(g, start, bounces);
  EXPECT_EQ(leaks.escaped, 0u) << what;
  EXPECT_EQ(leaks.wrong_side, 0u) << what;
}

Point3 centre_of(const Transform& t) { return to_float(t.point({0, 0, 0})); }

// A turned box of half size `size` around `at`, ng inwards.
Transform box_transform(double size, Vec3d at) {
  return Transform::translate(at) * generic_rotation() * Transform::scale({size, size, size});
}

Geometry box(const Transform& t) {
  Geometry g;
  g.meshes.push_back(box_mesh(t));
  g.meshes[0].flip_ng = true;
  g.groups[0].meshes = {0};
  return g;
}

void boxes_at_scales(uint64_t bounces) {
  for (const double scale : {1e-3, 1.0, 1e5}) expect_tight(box(box_transform(scale, {})), {}, bounces, "centred box");
}

void boxes_off_centre(uint64_t bounces) {
  for (const double scale : {1e-3, 1.0, 1e5})
    for (const double sizes : {10.0, 100.0}) {
      const Transform t = box_transform(scale, {1.3 * sizes * scale, -0.7 * sizes * scale, sizes * scale});
      expect_tight(box(t), centre_of(t), bounces, "box off the centre");
    }
}

// Not shared vertices but their copies, with inward vertex normals and uvs.
Geometry box_with_attributes() {
  const Mesh shared = box_mesh(box_transform(1.0, {2, 3, -1}));
  Geometry g;
  Mesh m;
  for (const auto& index : shared.triangles) {
    const Point3 p[3] = {shared.positions[index[0]], shared.positions[index[1]], shared.positions[index[2]]};
    const Vec3 inward = -normalize(cross(p[1] - p[0], p[2] - p[0]));
    const auto first = static_cast<uint32_t>(m.positions.size());
    for (int k = 0; k < 3; ++k) {
      m.positions.push_back(p[k]);
      m.normals.push_back(normalize(inward + Vec3{0.1f * static_cast<float>(k), 0.1f, 0}));
      m.uvs.push_back({static_cast<float>(k), static_cast<float>(k % 2)});
    }
    m.triangles.push_back({first, first + 1, first + 2});
  }
  g.meshes.push_back(std::move(m));
  g.groups[0].meshes = {0};
  return g;
}

// A sphere to be inside of.
Geometry hollow_sphere(const Transform& t) {
  Geometry g;
  g.quadrics.push_back(ellipsoid(t));
  g.quadrics[0].flip_ng = true;
  g.groups[0].quadric_end = 1;
  return g;
}

void hollow_spheres(uint64_t bounces) {
  for (const double scale : {1e-3, 1.0, 1e5})
    for (const double sizes : {0.0, 10.0, 1000.0})
      for (const double flat : {1.0, 0.2, 0.01}) {
        // There the rim's radius of curvature, 1e-4 sizes, is less than one step of its coordinates.
        if (flat < 0.1 && sizes > 100.0) continue;
        const Transform t = box_transform(scale, {1.3 * sizes * scale, -0.7 * sizes * scale, sizes * scale}) *
                            Transform::scale({1, flat, 1});
        expect_tight(hollow_sphere(t), centre_of(t), bounces, "hollow ellipsoid");
      }
}

// A box with three spheres in it, one of them flat and one small.
Geometry box_with_spheres(double scale, Vec3d at) {
  const Transform t = box_transform(scale, at);
  Geometry g = box(t);
  g.quadrics.push_back(ellipsoid(t * Transform::translate({0.5, -0.4, 0.3}) * Transform::scale({0.4, 0.4, 0.4})));
  g.quadrics.push_back(ellipsoid(t * Transform::translate({-0.4, 0.4, 0.1}) * Transform::rotate(30, {1, 1, 0}) *
                                 Transform::scale({0.4, 0.04, 0.3})));
  g.quadrics.push_back(ellipsoid(t * Transform::translate({-0.5, -0.5, -0.6}) * Transform::scale({1e-3, 1e-3, 1e-3})));
  g.groups[0].quadric_end = 3;
  return g;
}

// A box whose object space lies `sizes` away from its origin, and which an instance brings back to `at`.
Geometry instanced_box(double sizes, Vec3d at, Vec3d stretch) {
  Geometry g = box(Transform::translate({sizes, -0.6 * sizes, 0.2 * sizes}));
  g.groups.push_back({{0}, 0, 0});
  g.groups[0].meshes.clear();
  g.instances.push_back(instance_of(1, Transform::translate(at) * generic_rotation() * Transform::scale(stretch) *
                                           Transform::translate({-sizes, 0.6 * sizes, -0.2 * sizes})));
  return g;
}

void instanced_boxes(uint64_t bounces) {
  expect_tight(instanced_box(0, {}, {1, 1, 1}), {}, bounces, "instance");
  expect_tight(instanced_box(0, {10, 20, -5}, {1, 1, 1}), {10, 20, -5}, bounces, "instance off the centre");
  expect_tight(instanced_box(0, {10, 20, -5}, {1, 0.3, -4}), {10, 20, -5}, bounces, "stretched and mirrored instance");
  expect_tight(instanced_box(0, {1000, 2000, -500}, {100, 100, 100}), {1000, 2000, -500}, bounces, "large instance");
  expect_tight(instanced_box(100, {}, {1, 1, 1}), {}, bounces, "object space off its origin");
  expect_tight(instanced_box(1e4, {}, {1, 1, 1}), {}, bounces, "object space 10^4 sizes off its origin");
}

TEST(Leak, BoxesAtScales) { boxes_at_scales(kFast); }
TEST(Leak, BoxesOffCentre) { boxes_off_centre(kFast); }
TEST(Leak, BoxWithNormalsAndUvs) { expect_tight(box_with_attributes(), {2, 3, -1}, kFast, "attributes"); }
TEST(Leak, HollowSpheres) { hollow_spheres(kFast / 4); }
TEST(Leak, BoxWithSpheres) {
  expect_tight(box_with_spheres(1.0, {}), {}, kFast, "centred");
  expect_tight(box_with_spheres(1e5, {1e6, -2e6, 0}), {1e6f, -2e6f, 0}, kFast, "off the centre");
}
TEST(Leak, InstancedBoxes) { instanced_boxes(kFast); }

TEST(SlowLeak, BoxesAtScales) { boxes_at_scales(kSlow); }
TEST(SlowLeak, BoxesOffCentre) { boxes_off_centre(kSlow / 4); }
TEST(SlowLeak, HollowSpheres) { hollow_spheres(kSlow / 20); }
TEST(SlowLeak, BoxWithSpheres) { expect_tight(box_with_spheres(1.0, {}), {}, kSlow, "centred"); }
TEST(SlowLeak, InstancedBoxes) { instanced_boxes(kSlow / 4); }

// Rays that leave a convex body outwards meet nothing.
TEST(Leak, ConvexBodiesDoNotMeetTheirOwnRays) {
  HashStream h(7);
  for (int c = 0; c < 20; ++c) {
    const double scale = c % 3 == 0 ? 1e-3 : (c % 3 == 1 ? 1.0 : 1e5), off = c % 2 ? 0.0 : 15.0 * scale;
    const Transform t = box_transform(scale, {off, -off, 0.4 * off}) * Transform::scale({1, 1.0 / (1 + c), 0.5});
    Geometry g;
    g.meshes.push_back(box_mesh(t));
    g.quadrics.push_back(ellipsoid(t));
    (c < 10 ? g.groups[0].meshes.push_back(0) : void(g.groups[0].quadric_end = 1));
    const Accelerator accel(g);
    uint64_t hits = 0;
    for (uint32_t i = 0; i < 50000; ++i) {
      Vec3d n;
      const SurfacePoint s =
          c < 10 ? sample_triangle(g.meshes[0], i % 12, uniform(h)) : sample_quadric(g.quadrics[0], uniform(h), &n);
      const Vec3 w = cosine_direction(s.ng, h);
      hits += accel.occluded(spawn_ray(s, w));
    }
    EXPECT_EQ(hits, 0u) << "body " << c;
  }
}

// Thin triangles in every direction: needles of height 10^-4, obtuse slivers to where their bound is capped.
TEST(Leak, TrianglesDoNotMeetTheirOwnRays) {
  HashStream h(8);
  uint64_t hits = 0;
  for (uint32_t c = 0; c < 1200; ++c) {
    const bool needle = c % 2;
    const double height = std::pow(needle ? 1e-4 : 4e-3, h.next_float());
    const Vec2 at = uniform(h);
    const Transform t = Transform::translate({10.0 * at.x, 10.0 * at.y, 0}) *
                        Transform::rotate(360.0 * h.next_float(), to_double(sample_sphere_uniform(uniform(h))));
    Mesh m;
    m.positions = {to_float(t.point({0, 0, 0})), to_float(t.point({1, 0, 0})),
                   to_float(t.point({needle ? 0.0 : 0.5, height, 0}))};
    m.triangles = {{0, 1, 2}};
    Geometry g;
    g.meshes = {m};
    g.groups[0].meshes = {0};
    const Accelerator accel(g);
    for (int i = 0; i < 200; ++i) {
      const SurfacePoint s = sample_triangle(m, 0, uniform(h));
      const Vec3 w = cosine_direction(s.ng, h);
      hits += accel.occluded(spawn_ray(s, i % 2 ? w : -w));
    }
  }
  EXPECT_EQ(hits, 0u);
}

// A ray that enters a sphere finds its far side, and one that leaves it from there finds nothing.
TEST(Leak, SpheresAreCrossedOnce) {
  HashStream h(9);
  for (const double off : {0.0, 30.0, 3000.0}) {
    const Geometry g = [&] {
      Geometry made;
      made.quadrics.push_back(ellipsoid(box_transform(0.5, {off, off, -off})));
      made.groups[0].quadric_end = 1;
      return made;
    }();
    const Accelerator accel(g);
    for (int i = 0; i < 100000; ++i) {
      Vec3d n;
      const SurfacePoint in = sample_quadric(g.quadrics[0], uniform(h), &n);
      const Vec3 w = -cosine_direction(in.ng, h);
      Hit hit;
      ASSERT_TRUE(accel.intersect(spawn_ray(in, w), hit));
      const SurfacePoint out = surface_point(g, hit);
      ASSERT_GE(dot(out.ng, w), -1e-3f);
      ASSERT_FALSE(dot(out.ng, w) > 0.0f && accel.occluded(spawn_ray(out, w)));
    }
  }
}

// Segments between points of a convex room's walls are free, also over distances large beside the far surface.
TEST(Leak, SegmentsBetweenSurfacesAreFree) {
  HashStream h(11);
  for (const double scale : {1e-3, 1.0, 1e5}) {
    const Transform t = box_transform(scale, {9.0 * scale, 2.0 * scale, -5.0 * scale});
    const Geometry room = box(t);
    Geometry furnished = room;
    furnished.meshes.push_back(box_mesh(t * Transform::translate({0, 0.9, 0}) * Transform::scale({1e-3, 1e-3, 1e-3})));
    furnished.groups[0].meshes = {0, 1};
    const Accelerator empty_room(room), with_object(furnished);
    uint64_t blocked = 0, pairs = 0;
    while (pairs < 300000) {
      const uint32_t choice = h.next_u32(), target = choice >> 16 & 1;
      const SurfacePoint a = sample_triangle(furnished.meshes[0], choice % 12, uniform(h));
      const SurfacePoint b = sample_triangle(furnished.meshes[target], (choice >> 8) % 12, uniform(h));
      const Vec3 d = normalize(b.p - a.p);
      if (!(dot(d, a.ng) > 1e-4f && dot(d, b.ng) < -1e-4f)) continue;
      ++pairs;
      blocked += (target ? with_object : empty_room).occluded(shadow_ray(a, b));
    }
    EXPECT_EQ(blocked, 0u) << "scale " << scale;
  }
}

}  // namespace
}  // namespace etd
