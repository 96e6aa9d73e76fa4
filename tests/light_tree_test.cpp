// The choice among many lights by a tree: every light that may reach a receiver can be chosen, with the probability
// that is told, and the bounds of lights hold all that they emit.
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "core/hash.h"
#include "light_sampling/light_sampler.h"
#include "lights/examples.h"
#include "lights/light_list.h"

namespace etd {
namespace {

// Little triangles all over a cube, turned to all sides, of which every third emits from both.
struct ManyLights {
  Mesh mesh;
  std::vector<Light> lights;

  explicit ManyLights(uint32_t count) {
    HashStream rng(5);
    const auto number = [&] { return 2.0f * rng.next_float() - 1.0f; };
    for (uint32_t i = 0; i < count; ++i) {
      const Point3 at{number(), number(), number()};
      for (int corner = 0; corner < 3; ++corner)
        mesh.positions.push_back(at + Vec3{number(), number(), number()} * 0.02f);
      mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    for (uint32_t i = 0; i < count; ++i) {
      const float l = std::exp(3.0f * rng.next_float());
      lights.emplace_back(
          DiffuseAreaLight<TriangleSurface>({Spectrum(l), nullptr, i % 3 == 0}, TriangleSurface(mesh, i)));
    }
  }
};

LightReceiver some_receiver(HashStream& rng) {
  const auto number = [&] { return 2.6f * rng.next_float() - 1.3f; };
  LightReceiver r;
  r.p = {number(), number(), number()};
  r.n = normalize(Vec3{number(), number(), number()});
  r.both_sides = rng.next_float() < 0.3f;
  r.time = rng.next_float();
  return r;
}

TEST(LightTree, ProbabilitiesAreThoseOfSamples) {
  for (const uint32_t count : {2u, 3u, 17u, 5000u}) {
    const ManyLights many(count);
    const LightSampler sampler = make_light_sampler("bvh", {many.lights});
    HashStream rng(count);
    for (int k = 0; k < 200; ++k) {
      const LightReceiver r = some_receiver(rng);
      double sum = 0;
      if (k < 20)
        for (uint32_t i = 0; i < count; ++i) sum += static_cast<double>(sampler.probability(i, &r));
      int none = 0;
      for (int i = 0; i < 50; ++i) {
        const auto c = sampler.sample((i + static_cast<double>(rng.next_float())) / 50, &r);
        if (!c) {
          ++none;
          continue;
        }
        EXPECT_EQ(c->probability, sampler.probability(c->light, &r));
        EXPECT_GT(c->probability, 0.0f);
      }
      EXPECT_LE(sum, 1 + 1e-5);
      if (k < 20 && none == 0) {
        EXPECT_GT(sum, 0.97);
      }
    }
  }
}

// Light that reaches a receiver is that of a light with a probability.
TEST(LightTree, LeavesOutNoLightThatReachesTheReceiver) {
  const ManyLights many(2000);
  const LightSampler sampler = make_light_sampler("bvh", {many.lights});
  HashStream rng(3);
  int left_out = 0, reached = 0;
  for (int k = 0; k < 40; ++k) {
    const LightReceiver r = some_receiver(rng);
    for (uint32_t i = 0; i < many.lights.size(); ++i) {
      const auto s = many.lights[i].sample_li(r.p, {rng.next_float(), rng.next_float()}, {r.time});
      const bool reaches = s && (r.both_sides || dot(s->wi, r.n) > 0.0f);
      const bool can_be_chosen = sampler.probability(i, &r) > 0.0f;
      EXPECT_TRUE(can_be_chosen || !reaches) << i;
      reached += reaches;
      left_out += !can_be_chosen;
    }
  }
  EXPECT_GT(reached, 10000);
  EXPECT_GT(left_out, 10000);  // and most of those that do not reach it are left out
}

TEST(LightTree, IsTheSameForAnyNumberOfThreads) {
  const ManyLights many(20000);
  const LightSampler parallel = make_light_sampler("bvh", {many.lights});
  LightSampler alone;
  tbb::task_arena(1).execute([&] { alone = make_light_sampler("bvh", {many.lights}); });
  HashStream rng(8);
  for (int k = 0; k < 2000; ++k) {
    const LightReceiver r = some_receiver(rng);
    const double u = static_cast<double>(rng.next_float());
    const auto a = parallel.sample(u, &r), b = alone.sample(u, &r);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) continue;
    EXPECT_EQ(a->light, b->light);
    EXPECT_EQ(a->probability, b->probability);
  }
}

// One light is chosen always, and lights at one place do not stop the tree from being built.
TEST(LightTree, OneLightAndManyAtOnePlace) {
  const LightReceiver r;
  const Light lamp(PointLight<IsotropicIntensity>{{1, 2, 3}, {Spectrum(1.0f)}});
  const std::vector<Light> one(1, lamp), many(300, lamp);
  EXPECT_EQ(make_light_sampler("bvh", {one}).probability(0, &r), 1.0f);
  const LightSampler sampler = make_light_sampler("bvh", {many});
  double sum = 0;
  for (uint32_t i = 0; i < many.size(); ++i) {
    EXPECT_GT(sampler.probability(i, &r), 1.0f / 1000);
    sum += static_cast<double>(sampler.probability(i, &r));
  }
  EXPECT_NEAR(sum, 1, 1e-4);
}

// A lamp that goes from one place to another is found near where it is at the time.
TEST(LightTree, KnowsTheTime) {
  const TransformPath path = TransformPath().then(TransformPair(Transform(), Transform::translate({100, 0, 0})));
  const AnimatedTransform motion(path, Vec3d{}, 1.0);
  const Light lamp(PointLight<IsotropicIntensity>{{0, 0, 0}, {Spectrum(1.0f)}});
  const Light still(PointLight<IsotropicIntensity>{{0, 50, 0}, {Spectrum(1.0f)}});
  const std::vector<Light> lights{lamp.moving(motion), still};
  const LightSampler sampler = make_light_sampler("bvh", {lights});
  LightReceiver r;
  r.p = {100, 50, 0};
  r.time = 0;
  const float early = sampler.probability(0, &r);
  r.time = 1;
  EXPECT_GT(sampler.probability(0, &r), 1.5f * early);
}

TEST(LightBounds, HoldAllThatIsEmitted) {
  HashStream rng(11);
  const EmissionDisks disks(BoundingSphere{{}, 4.0f});
  for (const LightExample& e : light_examples()) {
    for (int part = 0; part < 4; ++part) {
      const float start = static_cast<float>(part) / 4, end = start + 0.25f;
      const auto bounds = e.light.bounds(start, end);
      EXPECT_EQ(bounds.has_value(), !e.light.is_infinite()) << e.name;
      if (!bounds) continue;
      EXPECT_GT(bounds->intensity, 0.0f) << e.name;
      for (int i = 0; i < 500; ++i) {
        const Vec2 place{rng.next_float(), rng.next_float()}, direction{rng.next_float(), rng.next_float()};
        const auto s = e.light.sample_le(place, direction, disks, {start + (end - start) * rng.next_float()});
        if (!s) continue;
        const Point3d p = to_double(s->on_light.p), nearest = bounds->box.nearest(p);
        EXPECT_LT(length(p - nearest), 1e-5) << e.name;
        float cosine = dot(bounds->cone.axis, s->ray.d);
        if (bounds->cone.both) cosine = std::abs(cosine);
        EXPECT_LT(std::acos(clamp(cosine, -1.0f, 1.0f)), bounds->cone.spread + bounds->fall + 2e-3f) << e.name;
      }
    }
  }
}

}  // namespace
}  // namespace etd
