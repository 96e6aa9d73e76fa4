// Maps of directions: where texels lie, and that value, density and samples are one function.
#include "lights/environment_map.h"

#include <gtest/gtest.h>

#include "core/hash.h"
#include "core/warp.h"
#include "verify/statistics/statistics.h"

namespace etd {
namespace {

Image grey(int width, int height, std::vector<float> values) { return {width, height, 1, std::move(values)}; }

// Values between 0 and 4, many of them 0, one of them large.
Image uneven(int width, int height) {
  HashStream numbers(7);
  std::vector<float> values;
  for (int i = 0; i < width * height * 3; ++i) values.push_back(std::max(0.0f, 5.0f * numbers.next_float() - 1.0f));
  values[static_cast<size_t>(width * height / 2 * 3 + 3)] = 60.0f;
  return {width, height, 3, std::move(values)};
}

Vec3 spherical(double theta, double phi) {
  return to_float(Vec3d{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
}

TEST(EqualAreaLayout, GoesThereAndBack) {
  HashStream numbers(1);
  for (int i = 0; i < 20000; ++i) {
    const float x = numbers.next_float(), y = numbers.next_float();
    const Vec3 w = equal_area_direction({x, y});
    ASSERT_NEAR(length(w), 1.0f, 2e-6f);
    const Vec2 st = equal_area_square(w);
    ASSERT_NEAR(st.x, x, 2e-6f);
    ASSERT_NEAR(st.y, y, 2e-6f);
  }
}

TEST(EqualAreaLayout, HasItsAxesWhereTheFormatHasThem) {
  const auto expect = [](Vec2 st, Vec3 w) {
    EXPECT_NEAR(length(equal_area_direction(st) - w), 0.0f, 1e-6f);
    EXPECT_NEAR(equal_area_square(w).x, st.x, 1e-6f);
    EXPECT_NEAR(equal_area_square(w).y, st.y, 1e-6f);
  };
  expect({0.5f, 0.5f}, {0, 0, 1});
  expect({1.0f, 0.5f}, {1, 0, 0});
  expect({0.0f, 0.5f}, {-1, 0, 0});
  expect({0.5f, 1.0f}, {0, 1, 0});
  expect({0.5f, 0.0f}, {0, -1, 0});
  for (const Vec2 corner : {Vec2{0, 0}, Vec2{1, 0}, Vec2{0, 1}, Vec2{1, 1}})
    EXPECT_NEAR(equal_area_direction(corner).z, -1.0f, 1e-6f);
}

// The Jacobian of the square's map is 4 pi everywhere.
TEST(EqualAreaLayout, KeepsAreas) {
  HashStream numbers(2);
  constexpr float kStep = 1e-3f;
  for (int i = 0; i < 2000; ++i) {
    // Away from the creases, where the map has no derivative.
    const float x = numbers.next_float(), y = numbers.next_float();
    const float a = std::abs(2 * x - 1), b = std::abs(2 * y - 1);
    if (a < 0.02f || b < 0.02f || std::abs(a + b - 1) < 0.02f || a > 0.98f || b > 0.98f) continue;
    const auto at = [&](float dx, float dy) { return to_double(equal_area_direction({x + dx, y + dy})); };
    const Vec3d du = (at(kStep, 0) - at(-kStep, 0)) / (2.0 * kStep),
                dv = (at(0, kStep) - at(0, -kStep)) / (2.0 * kStep);
    EXPECT_NEAR(length(cross(du, dv)), 4 * kPiD, 0.03 * kPiD);
  }
}

TEST(LatLongLayout, StartsAtPlusZAndTurnsFromXToY) {
  std::vector<float> values;
  for (int i = 0; i < 32; ++i) values.push_back(static_cast<float>(i));
  const EnvironmentMap map(grey(8, 4, values));
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 8; ++x)
      EXPECT_EQ(map.value(spherical((y + 0.4) * kPiD / 4, (x + 0.6) * 2 * kPiD / 8))[0], static_cast<float>(8 * y + x));
  EXPECT_EQ(map.value({0, 0, 1})[1], 0.0f);
  EXPECT_GE(map.value({0, 0, -1})[1], 24.0f);
}

class EnvironmentLayouts : public testing::TestWithParam<std::pair<int, int>> {
 protected:
  EnvironmentMap map_{uneven(GetParam().first, GetParam().second)};
};

TEST_P(EnvironmentLayouts, DensityIsInProportionToTheMeanColour) {
  HashStream numbers(3);
  for (int i = 0; i < 5000; ++i) {
    const float x = numbers.next_float(), y = numbers.next_float();
    const Vec3 w = sample_sphere_uniform({x, y});
    const float expected = mean_value(map_.value(w)) / mean_value(map_.integral());
    EXPECT_NEAR(map_.pdf(w, LightSampling::kComplete), expected, 1e-5f * expected);
  }
}

TEST_P(EnvironmentLayouts, CompensatedDensityIsInProportionToWhatExceedsTheAverage) {
  HashStream numbers(4);
  const float average = mean_value(map_.integral()) / (4 * kPi);
  float ratio = 0;
  for (int i = 0; i < 5000; ++i) {
    const float x = numbers.next_float(), y = numbers.next_float();
    const Vec3 w = sample_sphere_uniform({x, y});
    const float above = std::max(0.0f, mean_value(map_.value(w)) - average);
    const float pdf = map_.pdf(w, LightSampling::kCompensated);
    if (above < 1e-4f * average) continue;
    if (ratio == 0) ratio = pdf / above;
    EXPECT_NEAR(pdf, ratio * above, 1e-3f * pdf);
  }
  EXPECT_GT(ratio, 1.0f / mean_value(map_.integral()));
}

// Counts by cells of another grid than the map's own, against the density's integral over them.
TEST_P(EnvironmentLayouts, SamplesFollowTheDensity) {
  constexpr int kColumns = 24, kRows = 12, kSamples = 200000, kFine = 40;
  const auto cell_of = [](Vec3 w) {
    const float phi = std::atan2(w.y, w.x);
    const int column = static_cast<int>((phi * 0.5f * kInvPi + 0.5f) * kColumns);
    const int row = static_cast<int>((0.5f - 0.5f * w.z) * kRows);
    return static_cast<size_t>(std::clamp(row, 0, kRows - 1) * kColumns + std::clamp(column, 0, kColumns - 1));
  };
  for (const LightSampling sampling : {LightSampling::kComplete, LightSampling::kCompensated}) {
    std::vector<double> observed(kColumns * kRows, 0.0), expected(kColumns * kRows, 0.0);
    HashStream numbers(5);
    for (int i = 0; i < kSamples; ++i) {
      const float x = numbers.next_float(), y = numbers.next_float();
      const auto w = map_.sample({x, y}, sampling);
      ASSERT_TRUE(w);
      ASSERT_NEAR(length(*w), 1.0f, 2e-6f);
      observed[cell_of(*w)] += 1;
    }
    double total = 0;
    for (int i = 0; i < kRows * kFine; ++i)
      for (int j = 0; j < kColumns * kFine; ++j) {
        const double z = 1 - 2 * (i + 0.5) / (kRows * kFine), phi = 2 * kPiD * (j + 0.5) / (kColumns * kFine) - kPiD;
        const Vec3 w = spherical(std::acos(z), phi);
        const double mass = static_cast<double>(map_.pdf(w, sampling)) * 4 * kPiD / (kRows * kFine * kColumns * kFine);
        expected[cell_of(w)] += kSamples * mass;
        total += mass;
      }
    EXPECT_NEAR(total, 1.0, 2e-3);
    EXPECT_GT(chi_square_test(observed, expected, 20.0).p_value, 1e-5);
  }
}

TEST_P(EnvironmentLayouts, IntegralIsThatOfTheValues) {
  HashStream numbers(6);
  RunningStats lanes[3];
  for (int i = 0; i < 200000; ++i) {
    const float x = numbers.next_float(), y = numbers.next_float();
    const Spectrum value = map_.value(sample_sphere_uniform({x, y}));
    for (int c = 0; c < 3; ++c) lanes[c].add(4 * kPiD * value[c]);
  }
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(map_.integral()[c], lanes[c].mean(), 4.5 * std::sqrt(lanes[c].variance_of_mean()));
}

INSTANTIATE_TEST_SUITE_P(Sizes, EnvironmentLayouts,
                         testing::Values(std::pair{8, 8}, std::pair{7, 7}, std::pair{16, 8}, std::pair{2, 1}));

TEST(EnvironmentMap, ConstantMapsAreSampledEvenlyInBothWays) {
  for (const int width : {4, 8}) {
    const EnvironmentMap map(grey(width, 4, std::vector<float>(static_cast<size_t>(width) * 4, 2.0f)));
    for (const LightSampling sampling : {LightSampling::kComplete, LightSampling::kCompensated})
      EXPECT_NEAR(map.pdf({0.6f, 0.0f, 0.8f}, sampling), pdf_sphere_uniform(), 1e-6f);
    EXPECT_NEAR(map.irradiance_up()[0], 2 * kPi, 1e-3f);
  }
}

TEST(EnvironmentMap, BlackMapsHaveNoSamples) {
  const EnvironmentMap map(grey(2, 2, std::vector<float>(4, -1.0f)));
  EXPECT_FALSE(map.sample({0.5f, 0.5f}, LightSampling::kComplete));
  EXPECT_EQ(map.pdf({0, 0, 1}, LightSampling::kComplete), 0.0f);
  EXPECT_EQ(map.value({0, 0, 1})[0], 0.0f);
}

TEST(GridDistribution, NeverChoosesWhatHasNoWeight) {
  const std::vector<double> weights{0, 3, 0, 0, 0, 0, 0, 1, 0};
  const GridDistribution grid(3, 3, weights);
  for (int i = 0; i < 1000; ++i) {
    const float u = static_cast<float>(i) / 1000.0f;
    for (const float v : {0.0f, 0.3f, 0.75f, kOneMinusEpsilon}) {
      const auto s = grid.sample({u, v});
      EXPECT_GT(grid.probability(s.x, s.y), 0.0f);
      EXPECT_TRUE(s.offset.x >= 0 && s.offset.x < 1 && s.offset.y >= 0 && s.offset.y < 1);
    }
  }
  EXPECT_FLOAT_EQ(grid.probability(1, 0), 0.75f);
  EXPECT_FALSE(GridDistribution(2, 2, std::vector<double>(4, 0.0)).any());
}

}  // namespace
}  // namespace etd
