#include "verify/statistics/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "verify/statistics/quadrature.h"

namespace etd {
namespace {

// Quantiles of printed tables and closed forms.
TEST(Statistics, TailsAgreeWithTables) {
  EXPECT_NEAR(normal_sf(1.959963984540054), 0.025, 1e-14);
  EXPECT_NEAR(normal_sf(-1.0) + normal_sf(1.0), 1.0, 1e-15);
  EXPECT_NEAR(normal_sf(6.0) / 9.865876450376981e-10, 1.0, 1e-10);
  EXPECT_NEAR(student_t_sf(2.015048373, 5.0), 0.05, 1e-9);
  EXPECT_NEAR(student_t_sf(2.764, 10.0), 0.01, 2e-5);
  EXPECT_NEAR(student_t_sf(-6.314, 1.0), 0.95, 1e-5);
  EXPECT_NEAR(chi_square_sf(3.841458820694124, 1.0), 0.05, 1e-12);
  EXPECT_NEAR(chi_square_sf(18.307038053, 10.0), 0.05, 1e-9);
  EXPECT_NEAR(chi_square_sf(124.342113, 100.0), 0.05, 1e-7);
  EXPECT_NEAR(chi_square_sf(553.126802, 500.0), 0.05, 1e-6);
}

TEST(Statistics, TailsAgreeWithClosedForms) {
  for (double x : {0.1, 1.0, 7.0, 40.0, 300.0}) {
    EXPECT_NEAR(chi_square_sf(x, 2.0) / std::exp(-x / 2.0), 1.0, 1e-11);
    EXPECT_NEAR(chi_square_sf(x, 4.0) / (std::exp(-x / 2.0) * (1.0 + x / 2.0)), 1.0, 1e-11);
    EXPECT_NEAR(student_t_sf(x, 1.0), 0.5 - std::atan(x) / 3.14159265358979323846, 1e-12);
    EXPECT_NEAR(student_t_sf(x, 2.0), 0.5 - x / (2.0 * std::sqrt(2.0 + x * x)), 1e-12);
    EXPECT_NEAR(student_t_sf(std::min(x, 7.0), 1e8) / normal_sf(std::min(x, 7.0)), 1.0, 1e-4);
  }
  for (double x : {0.0, 0.2, 0.7, 1.0}) {
    EXPECT_NEAR(beta_regularised(1.0, 3.0, x), 1.0 - std::pow(1.0 - x, 3.0), 1e-14);
    EXPECT_NEAR(beta_regularised(2.5, 1.0, x), std::pow(x, 2.5), 1e-14);
  }
  EXPECT_EQ(chi_square_sf(0.0, 5.0), 1.0);
}

TEST(Statistics, LevelsOfManyTests) {
  EXPECT_NEAR(sidak_level(0.05, 10), 1.0 - std::pow(0.95, 0.1), 1e-15);
  EXPECT_NEAR(sidak_combined(sidak_level(1e-4, 1000), 1000), 1e-4, 1e-15);
  EXPECT_EQ(bonferroni_level(0.05, 10), 0.005);
  EXPECT_NEAR(repeated_level(1e-4, 4, 10), 5e-4, 1e-18);
}

RunningStats stats_of(std::initializer_list<double> values) {
  RunningStats s;
  for (double v : values) s.add(v);
  return s;
}

TEST(Statistics, WelchByHand) {
  // Means 3 and 6, variances of the means 2.5 / 5 and (20 / 3) / 4.
  const RunningStats a = stats_of({1, 2, 3, 4, 5}), b = stats_of({3, 5, 7, 9});
  const TestResult r = welch_test(a, b);
  const double va = 0.5, vb = 20.0 / 3.0 / 4.0;
  EXPECT_NEAR(r.statistic, -3.0 / std::sqrt(va + vb), 1e-12);
  EXPECT_NEAR(r.dof, (va + vb) * (va + vb) / (va * va / 4.0 + vb * vb / 3.0), 1e-12);
  EXPECT_NEAR(r.p_value, 2.0 * student_t_sf(std::abs(r.statistic), r.dof), 1e-12);
  EXPECT_EQ(welch_test(stats_of({1, 1}), stats_of({1, 1, 1})).p_value, 1.0);
  EXPECT_EQ(welch_test(stats_of({1, 1}), stats_of({2, 2})).p_value, 0.0);
}

TEST(Statistics, TTestByHand) {
  // Mean 3, variance of the mean 2.5 / 5.
  const TestResult r = t_test(stats_of({1, 2, 3, 4, 5}), 4.0);
  EXPECT_NEAR(r.statistic, -1.0 / std::sqrt(0.5), 1e-12);
  EXPECT_EQ(r.dof, 4.0);
  EXPECT_NEAR(r.p_value, 2.0 * student_t_sf(std::sqrt(2.0), 4.0), 1e-12);
  EXPECT_EQ(t_test(stats_of({2, 2}), 2.0).p_value, 1.0);
  EXPECT_EQ(t_test(stats_of({2, 2}), 2.5).p_value, 0.0);
}

TEST(Statistics, ChiSquarePoolsSmallCells) {
  const std::vector<double> expected{50, 1, 2, 40, 3, 0.5}, observed{45, 2, 1, 47, 1, 0.5};
  const TestResult r = chi_square_test(observed, expected, 6.0);
  // 0.5 + 1 + 2 + 3 = 6.5 are one pool.
  EXPECT_NEAR(r.statistic, 25.0 / 50.0 + 49.0 / 40.0 + 4.0 / 6.5, 1e-12);
  EXPECT_EQ(r.dof, 2.0);
  EXPECT_EQ(chi_square_test(std::vector<double>{1.0}, std::vector<double>{0.0}, 5.0).p_value, 0.0);
  EXPECT_EQ(chi_square_test(std::vector<double>{0.0, 9.0}, std::vector<double>{0.0, 9.0}, 5.0).p_value, 1.0);
}

TEST(Statistics, PValuesOfTrueHypothesesAreUniform) {
  std::mt19937_64 rng(1);
  std::uniform_int_distribution<int> cell(0, 49);
  int below = 0;
  const int repetitions = 2000;
  for (int i = 0; i < repetitions; ++i) {
    std::vector<double> observed(50), expected(50, 20.0);
    for (int n = 0; n < 1000; ++n) ++observed[static_cast<size_t>(cell(rng))];
    below += chi_square_test(observed, expected, 5.0).p_value < 0.1 ? 1 : 0;
  }
  EXPECT_NEAR(below / static_cast<double>(repetitions), 0.1, 0.03);
}

TEST(Quadrature, ConvergesOnAPeak) {
  const auto peak = [](double x, double y) {
    return std::array<double, 2>{std::exp(-200.0 * (x * x + y * y)) * 200.0 / 3.14159265358979323846, x * x * y};
  };
  const auto v = integrate_rect<2>(peak, {-0.5, 0.7, -0.6, 0.4}, 1e-8, 0.0);
  EXPECT_NEAR(v[0], 1.0, 1e-7);
  EXPECT_NEAR(v[1], (0.343 + 0.125) / 3.0 * (0.16 - 0.36) / 2.0, 1e-12);
}

}  // namespace
}  // namespace etd
