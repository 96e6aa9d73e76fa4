// The statistics behind every verdict: tail probabilities and the tests that use them. A verdict is a p-value, the
// probability of a result at least as bad if nothing is wrong; callers compare it with a level that accounts for how
// many tests they make.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace etd {

// Regularised upper incomplete gamma function Q(a, x) = Gamma(a, x) / Gamma(a); a > 0, x >= 0.
double gamma_q(double a, double x);
// Regularised incomplete beta function I_x(a, b); a, b > 0, x in [0, 1].
double beta_regularised(double a, double b, double x);

// Survival functions: the probability that the variable exceeds the argument.
double normal_sf(double z);
double student_t_sf(double t, double dof);
double chi_square_sf(double x, double dof);

// Probability of |Z| >= |z|, the p-value of a two-sided test.
double normal_two_sided(double z);
double student_t_two_sided(double t, double dof);

// The level for each of `tests` independent tests so that all of them together raise a false alarm with probability
// `family` (Sidak 1967); Bonferroni's holds for dependent tests too.
double sidak_level(double family, uint64_t tests);
double bonferroni_level(double family, uint64_t tests);
// The level for each of `tests` tests, dependent or not, in each of `groups` groups, where a group in which a test
// fails is tested again with fresh random numbers and raises an alarm only if a test fails again. Each run of a group
// fails by chance with a probability of at most tests * level, both with its square, so that groups (tests level)^2 =
// family.
double repeated_level(double family, uint64_t groups, uint64_t tests);
// The p-value of the smallest of `tests` independent p-values.
double sidak_combined(double smallest_p, uint64_t tests);

// The p-values of a family of tests, dependent or not, each corrected so that those below a level are, all together,
// false with at most that probability (Holm 1979).
std::vector<double> holm_corrected(std::span<const double> p_values);

// The probability of at least k successes in n independent trials of probability p.
double binomial_at_least(double k, double n, double p);

// The mean of `count` numbers, with the variance of that mean.
struct MeanEstimate {
  double mean = 0, variance_of_mean = 0;
  uint64_t count = 0;
};

// Mean and variance of a stream of numbers (Welford 1962).
class RunningStats {
 public:
  void add(double x);
  // Adds 0 this many times.
  void add_zeros(uint64_t times);
  uint64_t count() const { return count_; }
  double mean() const { return mean_; }
  // Returns the unbiased variance of the numbers; 0 for fewer than two.
  double variance() const { return count_ > 1 ? m2_ / static_cast<double>(count_ - 1) : 0.0; }
  double variance_of_mean() const { return count_ > 0 ? variance() / static_cast<double>(count_) : 0.0; }
  MeanEstimate estimate() const { return {mean_, variance_of_mean(), count_}; }

 private:
  uint64_t count_ = 0;
  double mean_ = 0, m2_ = 0;
};

struct TestResult {
  double statistic = 0;
  double dof = 0;
  double p_value = 1;
};

// Whether the mean of normally distributed numbers is `expected` (Student 1908); two-sided. Without any variance the
// answer is 1 for an equal mean and 0 otherwise.
TestResult t_test(const RunningStats& sample, double expected);

// Whether two means are equal, of samples whose variances may differ (Welch 1947); two-sided. Without any variance the
// answer is 1 for equal means and 0 otherwise.
TestResult welch_test(const MeanEstimate& a, const MeanEstimate& b);
TestResult welch_test(const RunningStats& a, const RunningStats& b);

// Whether a relative error `relative` in a mean of this size would be found with a probability of 9 in 10 by a t-test
// at the level, given the standard error of what is tested and its degrees of freedom.
bool would_be_seen(double relative, double mean, double standard_error, double dof, double level);

// Pearson's test of observed counts against expected ones. Cells of which fewer than `min_expected` are expected are
// pooled, smallest first. No parameter is fitted: dof = pooled cells - 1. A count where nothing at all is expected
// gives p = 0.
TestResult chi_square_test(std::span<const double> observed, std::span<const double> expected, double min_expected);

}  // namespace etd
