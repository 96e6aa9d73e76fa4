// Windows of tables, and the environment seen through portals, against sums and skies without one.
#include "lights/portal_map.h"

#include <gtest/gtest.h>

#include "core/hash.h"
#include "core/warp.h"

namespace etd {
namespace {

using Window = WindowedDistribution::Window;
using Point = WindowedDistribution::Point;

Vec2 uniform(HashStream& h) {
  const float x = h.next_float();
  return {x, h.next_float()};
}

constexpr int kWidth = 5, kHeight = 3;
const std::vector<double>& table() {
  static const std::vector<double> values{1, 2, 1, 4, 3, 0.5, 6, 1, 1, 2, 3, 1, 9, 0.1, 1};
  return values;
}

TEST(WindowedDistribution, IntegralsAreSums) {
  const WindowedDistribution d(kWidth, kHeight, table());
  for (const Window& w : {Window{{0, 0}, {1, 1}}, Window{{0.1, 0.2}, {0.9, 0.55}}, Window{{0.41, 0.35}, {0.45, 0.4}}}) {
    constexpr int kSteps = 600;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
      for (int j = 0; j < kSteps; ++j) {
        const double x = w.lo.x + (w.hi.x - w.lo.x) * (i + 0.5) / kSteps;
        const double y = w.lo.y + (w.hi.y - w.lo.y) * (j + 0.5) / kSteps;
        sum += table()[static_cast<size_t>(y * kHeight) * kWidth + static_cast<size_t>(x * kWidth)];
      }
    const double expected = sum / (kSteps * kSteps) * (w.hi.x - w.lo.x) * (w.hi.y - w.lo.y);
    EXPECT_NEAR(d.integral(w), expected, 3e-3 * expected);
  }
}

// Means of functions over samples, weighted by 1 / pdf, are their integrals: within 5 standard errors, which fails once
// in 10^6.
TEST(WindowedDistribution, SamplesFollowTheirDensity) {
  const WindowedDistribution d(kWidth, kHeight, table());
  HashStream h(3);
  for (const Window& w : {Window{{0, 0}, {1, 1}}, Window{{0.1, 0.2}, {0.9, 0.55}}, Window{{0.41, 0.35}, {0.45, 0.4}}}) {
    constexpr int kSamples = 20000;
    double sum = 0, sum2 = 0, area = 0;
    for (int i = 0; i < kSamples; ++i) {
      const Point p = d.sample(uniform(h), w);
      ASSERT_TRUE(w.contains(p));
      const double f = (p.x * p.x + p.y) / d.pdf(p, w);
      sum += f / kSamples, sum2 += f * f / kSamples, area += 1 / d.pdf(p, w) / kSamples;
    }
    const double wx = w.hi.x - w.lo.x, wy = w.hi.y - w.lo.y;
    const double expected =
        (std::pow(w.hi.x, 3) - std::pow(w.lo.x, 3)) / 3 * wy + (w.hi.y * w.hi.y - w.lo.y * w.lo.y) / 2 * wx;
    EXPECT_NEAR(sum, expected, 5 * std::sqrt((sum2 - sum * sum) / kSamples) + 1e-12);
    EXPECT_NEAR(area, wx * wy, 0.2 * wx * wy);
  }
  EXPECT_EQ(d.pdf({0.05, 0.3}, {{0.1, 0.2}, {0.9, 0.55}}), 0.0);
}

TEST(Portal, ShowsTheSkyThroughItselfAndNothingElse) {
  HashStream h(5);
  std::vector<float> values;
  for (int i = 0; i < 32 * 16 * 3; ++i) values.push_back(h.next_float() + 0.1f);
  const EnvironmentMap sky(Image(32, 16, 3, std::move(values)));
  const Frame axes = Frame::from_z(normalize(Vec3{1, 2, 3}));
  const Portal window{{-1, 0.5f, 2}, Frame::from_z(normalize(Vec3{0.1f, -0.2f, 1})), 1.5f, 2.0f};
  const PortalMap portal(sky, axes, window);
  int through = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 o = sample_sphere_uniform(uniform(h)) * (3 * h.next_float()), w = sample_sphere_uniform(uniform(h));
    const Point3 p{o.x, o.y, o.z};
    // The ray meets the window's plane at p + w t; this is in front of p if t is positive.
    const float along = dot(w, window.frame.z), t = dot(window.corner - p, window.frame.z) / along;
    const Vec3 at = window.frame.to_local(p + w * t - window.corner);
    const bool inside = along > 0 && t > 0 && at.x > 0 && at.x < 1.5f && at.y > 0 && at.y < 2;
    const float edge =
        std::min(std::min(std::abs(at.x), std::abs(at.x - 1.5f)), std::min(std::abs(at.y), std::abs(at.y - 2)));
    if (edge < 1e-3f || std::abs(along) < 1e-3f || std::abs(t) < 1e-3f) continue;
    through += inside;
    EXPECT_EQ(portal.value(p, w)[1], inside ? sky.value(axes.to_local(w))[1] : 0.0f);
    EXPECT_EQ(portal.pdf(p, w) > 0, inside);
  }
  EXPECT_GT(through, 300);
}

}  // namespace
}  // namespace etd
