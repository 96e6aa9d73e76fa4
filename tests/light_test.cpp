// The lights and the choice among them: samples against densities and closed forms, sides, power, and probabilities
// that are what they say.
#include "lights/light.h"

#include <gtest/gtest.h>

#include "core/distribution.h"
#include "core/hash.h"
#include "core/warp.h"
#include "light_sampling/light_sampler.h"
#include "lights/light_list.h"

namespace etd {
namespace {

AreaEmission uniform(float radiance, bool two_sided) {
  AreaEmission e;
  e.radiance = Spectrum(radiance);
  e.two_sided = two_sided;
  return e;
}

constexpr int kSteps = 256;

Mesh triangle_mesh(Point3 a, Point3 b, Point3 c) {
  Mesh m;
  m.positions = {a, b, c};
  m.triangles = {{0, 1, 2}};
  return m;
}

Quadric sphere(const Transform& t, bool reversed = false) { return Quadric(t, reversed); }

// The mean of 1 / pdf over a grid of samples: the solid angle that is sampled. Every sample is checked against pdf_li.
double sampled_solid_angle(const Light& light, Point3 p) {
  double sum = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const auto s =
          light.sample_li(p, {(static_cast<float>(i) + 0.5f) / kSteps, (static_cast<float>(j) + 0.5f) / kSteps}, {});
      if (!s) continue;
      sum += 1.0 / s->pdf;
      EXPECT_NEAR(length(s->wi), 1.0f, 1e-5f);
      EXPECT_NEAR(light.pdf_li(p, s->wi, &s->on_light, {}) / s->pdf, 1.0f, 2e-3f);
      EXPECT_EQ(light.emitted(&s->on_light, -s->wi, {})[0], s->radiance[0]);
      const float distance = length(s->on_light.p - p);
      EXPECT_LT(length(s->on_light.p - p - s->wi * distance), 1e-6f * distance);
    }
  return sum / (double(kSteps) * kSteps);
}

// Van Oosterom and Strackee 1983.
double triangle_solid_angle(Vec3d a, Vec3d b, Vec3d c) {
  const double la = length(a), lb = length(b), lc = length(c);
  return 2 * std::atan2(std::abs(dot(a, cross(b, c))), la * lb * lc + dot(a, b) * lc + dot(a, c) * lb + dot(b, c) * la);
}

TEST(DiffuseAreaLight, TriangleSolidAngleAndSides) {
  const Mesh m = triangle_mesh({0, 0, 0}, {2, 0, 0.5f}, {0.5f, 1, 1});
  const Point3 p{0.3f, -0.5f, 3}, behind{0.3f, 0.5f, -2};
  const auto exact = [&](Point3 q) {
    return triangle_solid_angle(to_double(m.positions[0] - q), to_double(m.positions[1] - q),
                                to_double(m.positions[2] - q));
  };
  for (const bool flip : {false, true}) {
    Mesh turned = m;
    turned.flip_ng = flip;
    const TriangleSurface surface(turned, 0);
    const Light one(DiffuseAreaLight<TriangleSurface>(uniform(3, false), surface));
    const Light two(DiffuseAreaLight<TriangleSurface>(uniform(3, true), surface));
    EXPECT_NEAR(sampled_solid_angle(one, flip ? behind : p), exact(flip ? behind : p), 1e-3);
    EXPECT_EQ(sampled_solid_angle(one, flip ? p : behind), 0.0);
    EXPECT_NEAR(sampled_solid_angle(two, p), exact(p), 1e-3);
    EXPECT_NEAR(sampled_solid_angle(two, behind), exact(behind), 1e-3);
    // Nothing is sampled towards the dark side, so its density is 0.
    const SurfacePoint s = sample_triangle(turned, 0, {0.3f, 0.3f});
    const Point3 dark = flip ? p : behind;
    EXPECT_EQ(one.pdf_li(dark, normalize(s.p - dark), &s, {}), 0.0f);
    EXPECT_GT(two.pdf_li(dark, normalize(s.p - dark), &s, {}), 0.0f);
    EXPECT_FALSE(one.is_infinite());
    EXPECT_NEAR(one.power()[0], 3 * kPi * surface.area(), 1e-4f);
    EXPECT_EQ(two.power()[0], 2 * one.power()[0]);
  }
}

TEST(DiffuseAreaLight, DegenerateTrianglesGiveNothing) {
  const Mesh m = triangle_mesh({1, 1, 1}, {2, 2, 2}, {3, 3, 3});
  const Light light(DiffuseAreaLight<TriangleSurface>(uniform(1, true), TriangleSurface(m, 0)));
  EXPECT_EQ(light.power()[0], 0.0f);
  EXPECT_FALSE(light.sample_li({0, 0, 1}, {0.3f, 0.3f}, {}));
  const SurfacePoint s = triangle_point(m, 0, 0.3f, 0.3f);
  EXPECT_EQ(light.pdf_li({0, 0, 1}, normalize(s.p - Point3{0, 0, 1}), &s, {}), 0.0f);
  // A point of the light itself sees no light from it.
  const Mesh flat = triangle_mesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const Light wide(DiffuseAreaLight<TriangleSurface>(uniform(1, false), TriangleSurface(flat, 0)));
  EXPECT_EQ(sampled_solid_angle(wide, {0.25f, 0.25f, 0}), 0.0);
}

TEST(DiffuseAreaLight, SphereFromOutside) {
  const Quadric s = sphere(Transform::translate({1, 2, 3}) * Transform::scale({0.5, 0.5, 0.5}));
  const Light one(DiffuseAreaLight<QuadricSurface>(uniform(2, false), QuadricSurface(s)));
  const Point3 p{1, 2, 5};  // four radii away
  const double cap = 2 * double{kPi} * (1 - std::sqrt(1 - 1 / 16.0));
  EXPECT_NEAR(sampled_solid_angle(one, p), cap, 0.01 * cap);
  EXPECT_NEAR(one.power()[0], 2 * kPi * kPi, 1e-4f);
  const Light two(DiffuseAreaLight<QuadricSurface>(uniform(2, true), QuadricSurface(s)));
  EXPECT_NEAR(sampled_solid_angle(two, p), cap, 0.01 * cap);  // the near side hides the far one
  const Quadric reversed = sphere(Transform::translate({1, 2, 3}), true);
  const Light inward(DiffuseAreaLight<QuadricSurface>(uniform(2, false), QuadricSurface(reversed)));
  EXPECT_NEAR(sampled_solid_angle(inward, {1.5f, 2, 3.2f}), 4 * kPi, 0.02);
}

// From inside, a closed surface fills the sphere of directions, whatever its shape.
TEST(DiffuseAreaLight, EllipsoidsFromInsideAndTheirPower) {
  const Transform t = Transform::translate({-3, 1, 0}) * Transform::rotate(33, {1, 2, 3}) *
                      Transform::scale({1, 2, 0.5}) * Transform::rotate(70, {3, 1, -1});
  for (const Transform& shape :
       {t, t * Transform::scale({-1, 1, 1}), Transform::scale({1e-3, 1e-3, 2e-3}), Transform::scale({1e4, 2e4, 1e4})}) {
    const Quadric s = sphere(shape, true);
    const Light light(DiffuseAreaLight<QuadricSurface>(uniform(1, false), QuadricSurface(s)));
    EXPECT_NEAR(sampled_solid_angle(light, to_float(shape.point({0.2, -0.1, 0.3}))), 4 * kPi, 0.05);
    double area = 0;  // the mean of 1 / pdf_area
    for (int i = 0; i < kSteps; ++i)
      for (int j = 0; j < kSteps; ++j) {
        float pdf = 0;
        QuadricSurface(s).sample({(static_cast<float>(i) + 0.5f) / kSteps, (static_cast<float>(j) + 0.5f) / kSteps},
                                 pdf);
        area += 1.0 / pdf / (double(kSteps) * kSteps);
      }
    EXPECT_NEAR(light.power()[0] / (kPi * area), 1.0, 1e-3);
  }
}

TEST(ConstantInfiniteLight, EveryDirectionAlike) {
  const Light light(ConstantInfiniteLight{Spectrum::rgb(1, 2, 3)});
  EXPECT_TRUE(light.is_infinite());
  Vec3 sum;
  for (int i = 0; i < 64; ++i)
    for (int j = 0; j < 64; ++j) {
      const auto s =
          light.sample_li({5, 5, 5}, {(static_cast<float>(i) + 0.5f) / 64, (static_cast<float>(j) + 0.5f) / 64}, {});
      ASSERT_TRUE(s);
      EXPECT_EQ(s->pdf, light.pdf_li({5, 5, 5}, s->wi, nullptr, {}));
      EXPECT_EQ(s->radiance[2], 3.0f);
      EXPECT_EQ(light.emitted(nullptr, -s->wi, {})[1], 2.0f);
      sum += s->wi;
    }
  EXPECT_LT(length(sum) / 4096, 1e-5f);
  EXPECT_FLOAT_EQ(light.pdf_li({}, {0, 0, 1}, nullptr, {}) * 4 * kPi, 1.0f);
  EXPECT_FLOAT_EQ(light.power()[0], 4 * kPi * kPi);
}

// The exact probability of each index: sums of the parts of the bins that lead to it, found by bisection.
std::vector<double> true_probabilities(const AliasTable& table) {
  const size_t n = table.size();
  std::vector<double> p(n, 0.0);
  for (size_t bin = 0; bin < n; ++bin) {
    const double w = 1.0 / static_cast<double>(n), start = static_cast<double>(bin) * w;
    // In a bin, sample() gives one index up to a threshold and another beyond it.
    double lo = 0, hi = 1;
    const uint32_t first = table.sample(start + w * 1e-14), last = table.sample(start + w * (1 - 1e-9));
    for (int i = 0; i < 60 && first != last; ++i) {
      const double middle = (lo + hi) / 2;
      (table.sample(start + w * middle) == first ? lo : hi) = middle;
    }
    p[first] += w * hi;
    p[last] += w * (1 - hi);
  }
  return p;
}

TEST(AliasTable, ProbabilitiesAreExact) {
  HashStream rng(6);
  for (const size_t n : {1, 2, 3, 10, 1000, 65536}) {
    std::vector<double> weights(n);
    double sum = 0;
    for (double& w : weights) {
      w = rng.next_float() < 0.3f ? 0.0 : std::pow(10.0, -9.0 * rng.next_float());
      sum += w;
    }
    weights[n / 2] += 1;
    sum += 1;
    const AliasTable table(weights);
    const std::vector<double> p = true_probabilities(table);
    for (size_t i = 0; i < n; ++i) {
      EXPECT_NEAR(table.probability(static_cast<uint32_t>(i)) * sum, weights[i], 1e-6 * weights[i]);
      EXPECT_NEAR(p[i], weights[i] / sum, 1e-5 * weights[i] / sum + 1e-7 / static_cast<double>(n)) << n << ' ' << i;
    }
  }
}

TEST(AliasTable, FaintThingsAreFound) {
  std::vector<double> weights(1000, 1.0);
  weights[500] = 1e-9;
  const AliasTable table(weights);
  EXPECT_EQ(table.sample(0.5 + 0.5e-12), 500u);
  EXPECT_NE(table.sample(0.5 + 2e-12), 500u);
}

TEST(AliasTable, WeightZeroIsNeverSampled) {
  for (const size_t n : {3, 7, 100, 4099}) {
    std::vector<double> weights(n, 0.0);
    for (size_t i = 1; i < n; i += 3) weights[i] = 0.1 * static_cast<double>(1 + i % 5);
    const AliasTable table(weights);
    for (size_t bin = 0; bin < n; ++bin)
      for (const double t : {0.0, 1e-12, 0.3, 0.7, 1 - 1e-12}) {
        const double u = std::min((static_cast<double>(bin) + t) / static_cast<double>(n), 1 - 0x1p-53);
        EXPECT_GT(weights[table.sample(u)], 0.0);
      }
  }
  const AliasTable dark(std::vector<double>{0, 0});
  EXPECT_EQ(dark.probability(0), 0.0f);
  EXPECT_EQ(dark.probability(1), 0.0f);
}

TEST(LightSampler, SharesOfFiniteAndInfiniteLights) {
  const Mesh m = triangle_mesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const auto area = [&](float l) {
    return Light(DiffuseAreaLight<TriangleSurface>(uniform(l, false), TriangleSurface(m, 0)));
  };
  const auto infinite = [](float l) { return Light(ConstantInfiniteLight{Spectrum(l)}); };
  const auto probabilities = [](const std::vector<Light>& lights) {
    const LightSampler sampler = make_light_sampler("power", {lights});
    std::vector<float> p;
    for (uint32_t i = 0; i < lights.size(); ++i) p.push_back(sampler.probability(i, nullptr));
    for (int i = 0; i < 1000; ++i) {
      const auto choice = sampler.sample((i + 0.5) / 1000, nullptr);
      if (!choice) continue;
      EXPECT_EQ(choice->probability, p[choice->light]);
      EXPECT_GT(choice->probability, 0.0f);
    }
    return p;
  };
  const std::vector<float> mixed = probabilities({area(1), infinite(1e6f), area(3), infinite(3e6f), area(0)});
  EXPECT_FLOAT_EQ(mixed[0], 0.125f);
  EXPECT_FLOAT_EQ(mixed[1], 0.125f);
  EXPECT_FLOAT_EQ(mixed[2], 0.375f);
  EXPECT_FLOAT_EQ(mixed[3], 0.375f);
  EXPECT_EQ(mixed[4], 0.0f);
  EXPECT_EQ(probabilities({area(1), infinite(0)}), (std::vector<float>{1, 0}));
  EXPECT_EQ(probabilities({infinite(1), area(0)}), (std::vector<float>{1, 0}));
  const std::vector<Light> four{area(1), infinite(1e6f), area(0), area(3)};
  const LightSampler alike = make_light_sampler("uniform", {four});
  EXPECT_FLOAT_EQ(alike.probability(0, nullptr), 1 / 3.0f);
  EXPECT_FLOAT_EQ(alike.probability(1, nullptr), 1 / 3.0f);
  EXPECT_EQ(alike.probability(2, nullptr), 0.0f);
  EXPECT_FLOAT_EQ(alike.probability(3, nullptr), 1 / 3.0f);
  const std::vector<Light> dark{area(0), infinite(0)};
  for (const LightSamplerModel& model : light_sampler_models()) {
    EXPECT_EQ(make_light_sampler(model.name, {four}).name(), model.name);
    EXPECT_FALSE(make_light_sampler(model.name, {dark}).sample(0.5, nullptr));
    EXPECT_EQ(make_light_sampler(model.name, {dark}).probability(1, nullptr), 0.0f);
    EXPECT_FALSE(make_light_sampler(model.name, {}).sample(0, nullptr));
  }
  EXPECT_FALSE(LightSampler().sample(0, nullptr));
}

}  // namespace
}  // namespace etd
