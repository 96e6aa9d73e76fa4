// Cut spheres, cylinders and disks: intersections against brute force, parametrisation, sampling, areas, and closed
// bodies made of them.
#include "shapes/quadric.h"

#include <gtest/gtest.h>

#include "accel/accelerator.h"
#include "accel/spawn.h"
#include "accel/surface.h"
#include "accel_scenes.h"
#include "core/frame.h"
#include "core/hash.h"
#include "core/warp.h"
#include "shapes/shape.h"

namespace etd {
namespace {

using Kind = QuadricPart::Kind;

const QuadricPart kParts[] = {{Kind::kSphere, -0.4f, 0.7f},         {Kind::kSphere, -1, 1, 2.0f},
                              {Kind::kSphere, 0.3f, 1, 5.0f},       {Kind::kCylinder, 0, 1},
                              {Kind::kCylinder, -0.5f, 1.5f, 1.0f}, {Kind::kDisk, 0, 1},
                              {Kind::kDisk, 0.5f, 1, 4.0f}};

Transform generic_map() {
  return Transform::translate({3, -2, 5}) * generic_rotation() * Transform::scale({1.5, 0.7, -1.2});
}

Vec2 uniform(HashStream& h) {
  const float x = h.next_float();
  return {x, h.next_float()};
}

// Every crossing of the line with the whole unit shape, kept where the part is.
std::optional<double> brute_force(const Quadric& quadric, Vec3d o, Vec3d d) {
  const QuadricPart& part = quadric.part;
  std::optional<double> nearest;
  double roots[2] = {-o.z / d.z, -1};
  if (part.kind != Kind::kDisk) {
    const double k = part.kind == Kind::kSphere ? 1 : 0;
    const double a = d.x * d.x + d.y * d.y + k * d.z * d.z, b = o.x * d.x + o.y * d.y + k * o.z * d.z;
    const double c = o.x * o.x + o.y * o.y + k * o.z * o.z - 1, h = b * b - a * c;
    if (h < 0) return {};
    roots[0] = (-b - std::sqrt(h)) / a, roots[1] = (-b + std::sqrt(h)) / a;
  }
  for (const double t : roots) {
    const Vec3d q = o + d * t;
    const double r = std::sqrt(q.x * q.x + q.y * q.y), along = part.kind == Kind::kDisk ? r : q.z;
    const double phi = std::atan2(q.y, q.x) + (q.y < 0 ? 2 * M_PI : 0);
    if (t > 0 && along >= part.lo && along <= part.hi && phi <= part.phi_max && (!nearest || t < *nearest)) nearest = t;
  }
  return nearest;
}

TEST(Quadric, IntersectionsAgreeWithBruteForce) {
  HashStream h(3);
  for (const QuadricPart& part : kParts) {
    const Transform map = generic_map();
    const Quadric quadric(map, false, part);
    int hits = 0, wrong = 0;
    for (int i = 0; i < 20000; ++i) {
      const Vec3d from = to_double(sample_sphere_uniform(uniform(h))) * 3.0;
      const Vec3d to = to_double(sample_sphere_uniform(uniform(h))) * (0.9 * h.next_float());
      const Point3 o = to_float(map.point({from.x, from.y, from.z}));
      const Vec3 d = to_float(map.vector(to - from));
      const Point3d oo = map.inverse().point(to_double(o));
      const auto expected = brute_force(quadric, {oo.x, oo.y, oo.z}, map.inverse().vector(to_double(d)));
      const auto found = quadric.intersect(o, d, kInfinity);
      hits += found.has_value();
      if (found.has_value() != expected.has_value()) {
        ++wrong;  // on an edge
        continue;
      }
      if (!found) continue;
      // What the maps' rounding moves across the surface moves t by as much over the cosine.
      const Vec3d q = quadric.unit_point_at(found->offset);
      const double cosine = std::abs(dot(normalize(d), quadric.normal(q)));
      ASSERT_NEAR(found->t, *expected, 1e-5 / std::max(cosine, 1e-3));
      ASSERT_LT(length((o + d * found->t) - quadric.point(q)), 1e-4f);
      ASSERT_FALSE(quadric.intersect(o, d, found->t));
    }
    EXPECT_GT(hits, 1000);
    EXPECT_LE(wrong, 2);
  }
}

// Everything at a point against differences of the points around it.
TEST(Quadric, ParametrisationIsThatOfTheFormat) {
  HashStream h(5);
  for (const QuadricPart& part : kParts) {
    const Quadric quadric(generic_map(), false, part);
    float least_u = 1, most_u = 0, least_v = 1, most_v = 0;
    for (int i = 0; i < 2000; ++i) {
      Vec3d q;
      const SurfacePoint s = sample_quadric(quadric, uniform(h), &q);
      least_u = std::min(least_u, s.uv.x), most_u = std::max(most_u, s.uv.x);
      least_v = std::min(least_v, s.uv.y), most_v = std::max(most_v, s.uv.y);
      const float du = 1e-3f;
      const double turn = double{du} * double{part.phi_max};
      const Vec3d turned{q.x * std::cos(turn) - q.y * std::sin(turn), q.x * std::sin(turn) + q.y * std::cos(turn), q.z};
      const double phi = std::atan2(q.y, q.x) + (q.y < 0 ? 2 * M_PI : 0);
      ASSERT_NEAR(s.uv.x, phi / part.phi_max, 1e-5);
      ASSERT_LT(length((quadric.point(turned) - s.p) * (1 / du) - s.dpdu), 0.05f * (0.01f + length(s.dpdu)));
      ASSERT_NEAR(dot(s.ng, s.dpdu), 0, 1e-4f);
      ASSERT_NEAR(dot(s.ng, s.dpdv), 0, 1e-4f * (1 + length(s.dpdv)));
      if (s.uv.y < 0.99f && s.uv.y > 0.05f) {
        const SurfacePoint up = quadric_point(quadric, quadric.unit_point(s.p + s.dpdv * 1e-3f));
        ASSERT_NEAR((up.uv.y - s.uv.y) / 1e-3f, 1, 0.02f);
      }
      ASSERT_NEAR(length(s.ng), 1, 1e-5f);
      ASSERT_LT(length(quadric.unit_point(s.p) - q), 1e-5);
    }
    EXPECT_LT(least_u, 0.01f);
    EXPECT_GT(most_u, 0.99f);
    EXPECT_LT(least_v, 0.05f);
    EXPECT_GT(most_v, 0.95f);
    EXPECT_GE(least_v, 0.0f);
    EXPECT_LE(most_v, 1.0f);
  }
  const Quadric disk(Transform(), false, kParts[5]), tube(Transform(), true, kParts[3]);
  EXPECT_FLOAT_EQ(quadric_point(disk, {0, 0.25, 0}).uv.y, 0.75f);
  EXPECT_EQ(quadric_point(disk, {0, 0.25, 0}).ng, (Vec3{0, 0, 1}));
  EXPECT_EQ(quadric_point(tube, {0, 1, 0.5}).ng, (Vec3{0, -1, 0}));
  EXPECT_FLOAT_EQ(quadric_point(tube, {0, 1, 0.25}).uv.y, 0.25f);
}

TEST(Quadric, AreasAndDensitiesBelongTogether) {
  HashStream h(7);
  for (const QuadricPart& part : kParts) {
    const Quadric quadric(generic_map(), false, part);
    double area = 0;
    constexpr int kSamples = 40000;
    for (int i = 0; i < kSamples; ++i) {
      Vec3d q;
      sample_quadric(quadric, uniform(h), &q);
      area += 1.0 / static_cast<double>(quadric_pdf_area(quadric, q)) / kSamples;
    }
    EXPECT_NEAR(area / quadric_area(quadric), 1, 0.01);
  }
  const Transform twice = Transform::scale({2, 2, 2});
  EXPECT_NEAR(quadric_area(Quadric(twice, false, kParts[0])), 4 * 2 * kPi * 1.1f, 1e-3f);
  EXPECT_NEAR(quadric_area(Quadric(twice, false, kParts[4])), 4 * 2.0f, 1e-4f);
  EXPECT_NEAR(quadric_area(Quadric(twice, false, kParts[6])), 4 * 4.0f * 0.375f, 1e-4f);
}

// Bodies closed by the same edges on two surfaces, all normals inwards.
Geometry can(const Transform& t) {
  Geometry g;
  g.quadrics = {Quadric(t * Transform::translate({0, 0, -1.3}) * Transform::scale({1, 1, 2}), true, kParts[3]),
                Quadric(t * Transform::translate({0, 0, -1.3}), false, kParts[5]),
                Quadric(t * Transform::translate({0, 0, 0.7}), true, kParts[5])};
  g.groups[0].quadric_end = 3;
  return g;
}
Geometry capped_sphere(const Transform& t) {
  const double z = -0.4f, r = std::sqrt(1 - z * z);
  Geometry g;
  g.quadrics = {Quadric(t, true, {Kind::kSphere, -0.4f, 1}),
                Quadric(t * Transform::translate({0, 0, z}) * Transform::scale({r, r, r}), false, kParts[5])};
  g.groups[0].quadric_end = 2;
  return g;
}

void expect_closed(const Geometry& g, Point3 centre, uint64_t bounces, const char* what) {
  const Accelerator accel(g);
  HashStream h(1);
  uint64_t escaped = 0, behind = 0;
  Ray ray{centre, sample_sphere_uniform(uniform(h))};
  for (uint64_t i = 0; i < bounces; ++i) {
    Hit hit;
    if (!accel.intersect(ray, hit)) {
      ++escaped;
      ray = {centre, sample_sphere_uniform(uniform(h))};
      continue;
    }
    const SurfacePoint s = surface_point(g, hit);
    behind += dot(normalize(ray.d), s.ng) > 1e-3f;
    Vec3 w;
    do {
      w = Frame::from_z(s.ng).to_world(sample_hemisphere_cosine(uniform(h)));
    } while (!(dot(w, s.ng) > 0.0f));
    ray = spawn_ray(s, w);
  }
  EXPECT_EQ(escaped, 0u) << what;
  EXPECT_EQ(behind, 0u) << what;
}

void closed_bodies(uint64_t bounces) {
  for (const double scale : {1e-3, 1.0, 1e5})
    for (const double sizes : {0.0, 100.0}) {
      const Transform t = Transform::translate({1.3 * sizes * scale, -0.7 * sizes * scale, sizes * scale}) *
                          generic_rotation() * Transform::scale({scale, 0.8 * scale, -scale});
      const Point3 centre = to_float(t.point({0, 0, 0}));
      expect_closed(can(t), centre, bounces, "can");
      expect_closed(capped_sphere(t), centre, bounces, "capped sphere");
    }
}

TEST(QuadricLeak, ClosedBodiesAreTight) { closed_bodies(200000); }
TEST(SlowQuadricLeak, ClosedBodiesAreTight) { closed_bodies(10000000); }

TEST(QuadricLeak, ARayDoesNotMeetWhatItLeaves) {
  HashStream h(11);
  for (const QuadricPart& part : kParts) {
    if (part.kind != Kind::kDisk && part.kind != Kind::kCylinder) continue;
    for (const double off : {0.0, 100.0}) {
      Geometry g;
      g.quadrics = {Quadric(Transform::translate({off, -off, off}) * generic_map(), false, part)};
      g.groups[0].quadric_end = 1;
      const Accelerator accel(g);
      uint64_t hits = 0;
      for (int i = 0; i < 50000; ++i) {
        Vec3d q;
        const SurfacePoint s = sample_quadric(g.quadrics[0], uniform(h), &q);
        const Vec3 w = Frame::from_z(s.ng).to_world(sample_hemisphere_cosine(uniform(h)));
        if (!(dot(w, s.ng) > 0.0f)) continue;
        hits += accel.occluded(spawn_ray(s, w));
        if (part.kind == Kind::kDisk) hits += accel.occluded(spawn_ray(s, -w));
      }
      EXPECT_EQ(hits, 0u);
    }
  }
}

TEST(QuadricShapes, NothingLeftIsAnError) {
  const auto problem = [](const char* shape, std::vector<std::pair<const char*, double>> values) {
    ModelUse use{shape, {}, {}};
    for (const auto& [name, value] : values) {
      Param p;
      p.name = name;
      p.numbers = {value};
      use.params.push_back(p);
    }
    Diagnostics diagnostics;
    MeshFiles files;
    const bool made = make_shape(use, {}, files, diagnostics).has_value();
    EXPECT_EQ(made, !diagnostics.has_errors());
    return made ? std::string() : diagnostics.all()[0].message;
  };
  EXPECT_EQ(problem("sphere", {{"zmin", 1}, {"zmax", 3}}), "nothing of the sphere lies between \"zmin\" and \"zmax\"");
  EXPECT_EQ(problem("cylinder", {{"zmax", -1}}), "nothing of the cylinder lies between \"zmin\" and \"zmax\"");
  EXPECT_EQ(problem("disk", {{"innerradius", 2}}), "nothing of the disk lies between \"radius\" and \"innerradius\"");
  EXPECT_EQ(problem("sphere", {{"zmin", -9}, {"zmax", 9}}), "");
  EXPECT_EQ(problem("cylinder", {{"zmin", 2}, {"zmax", -2}}), "");
}

}  // namespace
}  // namespace etd
