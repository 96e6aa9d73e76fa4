// What moves: our interpolation against Embree's, rays at any time against the geometry as it then is, and rays in
// moving rooms, which must neither leave them nor meet the wall they start on.
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

double uniform(HashStream& h, double lo, double hi) { return lo + (hi - lo) * static_cast<double>(h.next_float()); }

Vec3d random_vector(HashStream& h, double size) {
  const double x = uniform(h, -size, size), y = uniform(h, -size, size);
  return {x, y, uniform(h, -size, size)};
}

// Turns by up to `degrees`, stretches and mirrors.
Transform random_transform(HashStream& h, double degrees, bool mirror) {
  const Vec3d s = random_vector(h, 0.4);
  const Transform skewed = Transform::scale({1 + s.x, 1 + s.y, mirror ? s.z - 1 : 1 + s.z}) *
                           Transform::rotate(30, random_vector(h, 1)) * Transform::scale({1 + s.z, 1, 1});
  return Transform::translate(random_vector(h, 3)) * Transform::rotate(uniform(h, 0, degrees), random_vector(h, 1)) *
         skewed;
}

TransformPair random_motion(HashStream& h, double degrees) {
  const Transform start = random_transform(h, 360, h.next_float() < 0.3f);
  const Vec3d s = random_vector(h, 0.3);
  const Transform change = Transform::translate(random_vector(h, 1)) * Transform::rotate(degrees, random_vector(h, 1)) *
                           Transform::scale({1 + s.x, 1, 1 + s.z});
  return {start, change * start};
}

// The largest difference of two points of the box [-1, 1]^3 under the maps.
double difference(const Transform& a, const Transform& b) {
  double largest = 0;
  for (int i = 0; i < 8; ++i) {
    const Point3d p{i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0};
    largest = std::max(largest, length(a.point(p) - b.point(p)));
  }
  return largest;
}

TEST(AnimatedTransform, PartsMakeTheWhole) {
  HashStream h(1);
  for (int i = 0; i < 1000; ++i) {
    const Transform t = random_transform(h, 180, i % 2);
    const TransformParts parts = TransformParts::of(t.matrix());
    EXPECT_LT(difference(parts.transform(), t), 1e-13);
    EXPECT_LT(difference(parts.transform() * t.inverse(), Transform()), 1e-12);
    EXPECT_LT(difference(parts.transform().inverse() * t, Transform()), 1e-12);
    EXPECT_EQ(parts.scale.z < 0, i % 2 == 1);
  }
}

TEST(AnimatedTransform, TurnsAtConstantSpeedByTheShorterWay) {
  for (const double degrees : {2.0, 40.0, 120.0, 179.0, 250.0}) {
    const TransformPath path = TransformPath().then(TransformPair(Transform(), Transform::rotate(degrees, {1, 2, -1})));
    const double by = degrees > 180 ? degrees - 360 : degrees;
    for (const double t : {0.0, 0.2, 0.5, 0.9, 1.0})
      EXPECT_LT(difference(path.at(t), Transform::rotate(t * by, {1, 2, -1})), 2e-6) << degrees;
  }
}

// What is compiled for rays is the path: around a centre, mirrored, and for turns within turns.
TEST(AnimatedTransform, KeysFollowThePath) {
  HashStream h(2);
  for (int i = 0; i < 60; ++i) {
    TransformPath path = TransformPath().then(random_motion(h, uniform(h, 0, 170)));
    if (i % 3 == 0) path = path.then(Transform::translate({1, 2, 3})).then(random_motion(h, uniform(h, 0, 90)));
    const Vec3d centre = random_vector(h, 2);
    const AnimatedTransform keys(path, centre, 2);
    for (int k = 0; k <= 100; ++k) {
      const float time = static_cast<float>(k) / 100;
      const Transform wanted = path.at(time) * Transform::translate(centre);
      EXPECT_LT(difference(keys.at(time), wanted), i % 3 == 0 ? 1e-3 : 2e-5);
      EXPECT_LT(difference(keys.at(time) * keys.at(time).inverse(), Transform()), 1e-12);
    }
  }
}

TEST(AnimatedTransform, RigidMotionsAreKnown) {
  const TransformPair turn{Transform::translate({1, 2, 3}), Transform::rotate(100, {1, 0, 2})};
  EXPECT_TRUE(AnimatedTransform(TransformPath().then(turn), {1, 1, 1}, 1).is_rigid());
  const TransformPair growth{Transform(), Transform::scale({2, 2, 2})};
  const AnimatedTransform grows(TransformPath().then(growth), {}, 1);
  EXPECT_FALSE(grows.is_rigid());
  EXPECT_NEAR(grows.mean_area_scale(), 7.0 / 3.0, 1e-6);
}

Mesh group_box() { return box_mesh(Transform()); }

// A box that moves, its space's origin off its centre.
Geometry moving_box(const TransformPath& path, Vec3d centre = {}) {
  Geometry g;
  g.meshes.push_back(group_box());
  g.meshes[0].flip_ng = true;
  g.groups.push_back({{0}, 0, 0});
  GeometryInstance& instance = g.instances.emplace_back();
  instance.group = 1;
  instance.motion = &g.motions.emplace_back(path, centre, 2.0);
  return g;
}

// The bound of placement_error counts on this: 7 units in the last place of float for each entry of a rotation.
TEST(AnimatedTransform, AgreesWithEmbree) {
  HashStream h(3);
  double worst = 0;
  for (int i = 0; i < 100; ++i) {
    TransformPath path = TransformPath().then(random_motion(h, uniform(h, 0, 179)));
    if (i % 4 == 0) path = path.then(random_motion(h, uniform(h, 0, 90)));
    const Geometry g = moving_box(path, random_vector(h, 2));
    const Accelerator accel(g);
    for (int k = 0; k <= 100; ++k) {
      const float time = k == 100 ? 1.0f : h.next_float();
      const Placement ours = g.placement(0, time);
      const Affine theirs = accel.instance_to_world(0, time);
      const double size = 1 + length(ours.to_world.t) + ours.pivot + 2 * length(ours.to_world.x) +
                          length(ours.to_world.y) + length(ours.to_world.z);
      for (const auto member : {&Affine::x, &Affine::y, &Affine::z, &Affine::t})
        worst = std::max(worst, double(max_component(abs(ours.to_world.*member - theirs.*member))) / size);
    }
  }
  EXPECT_LT(worst, 7 * 0x1p-24);
}

// The geometry as it is at a time, as one that rests.
Geometry frozen(const Geometry& g, float time) {
  Geometry still = g;
  for (uint32_t i = 0; i < still.instances.size(); ++i) {
    static_cast<Placement&>(still.instances[i]) = g.placement(i, time);
    still.instances[i].motion = nullptr;
  }
  for (Mesh& mesh : still.meshes) {
    if (mesh.motion_steps == 1) continue;
    const size_t count = mesh.vertex_count();
    const double at = time * static_cast<double>(mesh.motion_steps - 1);
    const auto step = static_cast<size_t>(std::min(std::floor(at), static_cast<double>(mesh.motion_steps - 2)));
    std::vector<Point3> positions;
    positions.reserve(count + 1);
    for (size_t v = 0; v < count; ++v) {
      const Point3d a = to_double(mesh.positions[step * count + v]),
                    b = to_double(mesh.positions[(step + 1) * count + v]);
      positions.push_back(to_float(a + (b - a) * (at - static_cast<double>(step))));
    }
    mesh.positions = std::move(positions);
    mesh.motion_steps = 1;
  }
  return still;
}

// A box whose corners wander, over `steps` moments.
Mesh deforming_box(HashStream& h, const Transform& t, uint32_t steps, double by) {
  const Mesh box = box_mesh(t);
  Mesh mesh = box;
  mesh.positions.clear();
  mesh.motion_steps = steps;
  for (uint32_t s = 0; s < steps; ++s)
    for (const Point3& p : box.positions) mesh.positions.push_back(p + to_float(random_vector(h, by)));
  mesh.positions.reserve(mesh.positions.size() + 1);
  return mesh;
}

// Many things that move, deform, or both, and some that rest.
Geometry moving_things(uint64_t seed) {
  HashStream h(seed);
  Geometry g;
  g.meshes.push_back(box_mesh(Transform::translate({0, 0, -4}) * Transform::scale({0.7, 0.5, 0.3})));
  g.meshes.push_back(deforming_box(h, Transform::translate({-3, 2, 0}), 4, 0.5));
  g.groups[0].meshes = {0, 1};
  g.groups[0].quadric_end = 1;
  g.quadrics.push_back(ellipsoid(Transform::translate({3, -3, 1}) * Transform::scale({0.5, 0.8, 1.1})));
  for (uint32_t group = 1; group <= 2; ++group) {
    const auto mesh = static_cast<uint32_t>(g.meshes.size()), quadric = static_cast<uint32_t>(g.quadrics.size());
    g.meshes.push_back(group == 1 ? box_mesh(Transform::scale({0.6, 0.4, 0.8}))
                                  : deforming_box(h, Transform(), 2, 0.4));
    g.quadrics.push_back(ellipsoid(Transform::translate({0.8, 0, 0.3}) * Transform::scale({0.3, 0.5, 0.4})));
    g.groups.push_back({{mesh}, quadric, quadric + 1});
  }
  for (uint32_t i = 0; i < 6; ++i) {
    GeometryInstance& instance = g.instances.emplace_back(instance_of(1 + i % 2, random_transform(h, 180, false)));
    if (i == 5) continue;
    TransformPath path = TransformPath().then(random_motion(h, uniform(h, 0, 170)));
    if (i == 3) path = path.then(random_motion(h, 60));
    instance.motion = &g.motions.emplace_back(path, random_vector(h, 1), 2.0);
  }
  return g;
}

TEST(Motion, RaysMeetWhatIsThereAtTheirTime) {
  int hits = 0, disagreements = 0;
  for (uint64_t seed = 1; seed <= 3; ++seed) {
    const Geometry g = moving_things(seed);
    const Accelerator moving(g);
    HashStream h(seed + 50);
    for (int moment = 0; moment <= 20; ++moment) {
      const float time = moment == 20 ? 1.0f : moment == 0 ? 0.0f : h.next_float();
      const Geometry then = frozen(g, time);
      const Accelerator still(then);
      for (int i = 0; i < 1000; ++i) {
        const Point3 from = Point3{} + to_float(random_vector(h, 8)), to = Point3{} + to_float(random_vector(h, 3));
        const Ray ray{from, to - from, i % 2 ? kInfinity : 1.0f, time};
        Hit hit, expected;
        const bool found = moving.intersect(ray, hit);
        EXPECT_EQ(moving.occluded(ray), found);
        const bool should = still.intersect(ray, expected);
        if (found != should || hit.geometry != expected.geometry || hit.primitive != expected.primitive ||
            hit.instance != expected.instance || std::abs(hit.t - expected.t) > 1e-4f) {
          ++disagreements;  // edges
          continue;
        }
        if (!found) continue;
        ++hits;
        EXPECT_EQ(hit.time, time);
        expected.time = time;
        const SurfacePoint a = surface_point(g, hit), b = surface_point(then, expected);
        EXPECT_LT(length(a.p - b.p), 5e-4f);
        EXPECT_LT(std::abs(dot(a.p - (ray.o + ray.d * hit.t), a.ng)), 2e-5f);
        EXPECT_GT(dot(a.ng, b.ng), 0.999f);
        EXPECT_LT(length(a.dpdu - b.dpdu), 1e-2f * (1 + length(b.dpdu)));
      }
    }
  }
  EXPECT_GT(hits, 10000);
  EXPECT_LE(disagreements, 20);
}

TEST(Motion, NormalsOfDeformingMeshesAreInterpolated) {
  Mesh m;
  m.motion_steps = 2;
  m.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  m.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0.6f, 0.8f}, {0, 0.6f, 0.8f}, {0, 0.6f, 0.8f}};
  m.triangles = {{0, 1, 2}};
  const SurfacePoint s = triangle_point(m, 0, 0.25f, 0.5f, 0.5f);
  EXPECT_LT(length(s.p - Point3{0.25f, 0.5f, 0.5f}), 1e-6f);
  EXPECT_LT(length(s.ns - normalize(Vec3{0, 0.3f, 0.9f})), 1e-6f);
  EXPECT_LT(length(s.ng - Vec3{0, 0, 1}), 1e-6f);
}

// Every ng points into the closed space, which surrounds `start` at all times. Paths of 10 bounces at random times.
void expect_tight(const Geometry& g, Point3 start, int bounces, const char* what) {
  const Accelerator accel(g);
  HashStream h(11);
  int escaped = 0, wrong_side = 0;
  Ray ray;
  for (int i = 0; i < bounces; ++i) {
    if (i % 10 == 0) ray = {start, sample_sphere_uniform({h.next_float(), h.next_float()}), kInfinity, h.next_float()};
    Hit hit;
    if (!accel.intersect(ray, hit)) {
      ++escaped;
      i += 9 - i % 10;
      continue;
    }
    const SurfacePoint s = surface_point(g, hit);
    if (dot(normalize(ray.d), s.ng) > 1e-4f) {
      ++wrong_side;
      i += 9 - i % 10;
      continue;
    }
    Vec3 w;
    do w = Frame::from_z(s.ng).to_world(sample_hemisphere_cosine({h.next_float(), h.next_float()}));
    while (!(dot(w, s.ng) > 0.0f));
    ray = spawn_ray(s, w, ray);
  }
  EXPECT_EQ(escaped, 0) << what;
  EXPECT_EQ(wrong_side, 0) << what;
}

TEST(MotionLeak, MovingBoxes) {
  constexpr int kBounces = 200000;
  const Transform turn = Transform::rotate(150, {0.3, -0.8, 0.52}), small = Transform::translate({0.3, -0.2, 0.1});
  for (const double scale : {1e-3, 1.0, 1e5})
    for (const double away : {0.0, 30.0}) {
      const Vec3d at{away * scale, -0.6 * away * scale, 0.2 * away * scale};
      const TransformPath outer =
          TransformPath().then(Transform::translate(at)).then(Transform::scale({scale, scale, scale}));
      const Point3 start{static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)};
      expect_tight(moving_box(outer.then(TransformPair(Transform(), small * turn))), start, kBounces, "turning box");
      expect_tight(moving_box(outer.then(TransformPair(Transform(), small))), start, kBounces, "sliding box");
      expect_tight(
          moving_box(outer.then(TransformPair(Transform::scale({1, 2, 1}),
                                              turn * Transform::scale({3, 1, -1}) * Transform::scale({1, 1, -1})))),
          start, kBounces, "stretching box");
      // Around a pivot 20 sizes away, so that the centre goes a long way.
      const TransformPair swing{Transform(), Transform::rotate(2, {0, 0, 1})};
      expect_tight(moving_box(outer.then(Transform::translate({-20, 0, 0})).then(swing), {20, 0, 0}), start, kBounces,
                   "swinging box");
      HashStream h(5);
      Geometry deforming;
      deforming.meshes.push_back(deforming_box(h, outer.at(0) * generic_rotation(), 5, 0.3 * scale));
      deforming.meshes[0].flip_ng = true;
      deforming.groups[0].meshes = {0};
      expect_tight(deforming, start, kBounces, "deforming box");
    }
}

// A sphere and a box with balls in it, all turning.
TEST(MotionLeak, MovingQuadrics) {
  const TransformPair turn{Transform::translate({5, 0, 0}),
                           Transform::translate({5, 0.2, 0}) * Transform::rotate(100, {1, 2, 3})};
  Geometry g = moving_box(TransformPath().then(turn));
  g.quadrics.push_back(ellipsoid(Transform::translate({0.5, -0.4, 0.3}) * Transform::scale({0.4, 0.2, 0.4})));
  g.quadrics.push_back(ellipsoid(Transform::translate({-0.5, -0.5, -0.6}) * Transform::scale({1e-3, 1e-3, 1e-3})));
  g.groups[1].quadric_end = 2;
  expect_tight(g, {5, 0, 0}, 200000, "box with balls");
  Geometry sphere = moving_box(TransformPath().then(turn));
  sphere.quadrics.push_back(ellipsoid(Transform()));
  sphere.quadrics[0].flip_ng = true;
  sphere.groups[1] = {{}, 0, 1};
  expect_tight(sphere, {5, 0, 0}, 200000, "hollow sphere");
}

}  // namespace
}  // namespace etd
