#include "verify/statistics/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace etd {

namespace {

constexpr double kTiny = 1e-300;
constexpr double kPrecision = 1e-15;
constexpr int kMaxTerms = 100000;

// One step of the modified Lentz method for continued fractions (Thompson and Barnett 1986): multiplies in the term
// numerator / (denominator + ...). True when the fraction has converged.
struct ContinuedFraction {
  double value, c, d = 0;

  explicit ContinuedFraction(double first) : value(first == 0.0 ? kTiny : first), c(value) {}
  bool step(double numerator, double denominator) {
    d = denominator + numerator * d;
    if (d == 0.0) d = kTiny;
    c = denominator + numerator / c;
    if (c == 0.0) c = kTiny;
    d = 1.0 / d;
    const double factor = c * d;
    value *= factor;
    return std::abs(factor - 1.0) < kPrecision;
  }
};

}  // namespace

// The series of P below the mean, the continued fraction of Q above it (Abramowitz and Stegun 6.5.29, 6.5.31).
double gamma_q(double a, double x) {
  if (!(x > 0.0)) return 1.0;
  if (std::isinf(x)) return 0.0;
  const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1.0) {
    double term = 1.0 / a, sum = term;
    for (int n = 1; n < kMaxTerms && term > sum * kPrecision; ++n) {
      term *= x / (a + n);
      sum += term;
    }
    return 1.0 - front * sum;
  }
  ContinuedFraction f(x + 1.0 - a);
  for (int n = 1; n < kMaxTerms; ++n)
    if (f.step(-n * (n - a), x + 2.0 * n + 1.0 - a)) break;
  return front / f.value;
}

// The continued fraction of Abramowitz and Stegun 26.5.8, on the side where it converges fast.
double beta_regularised(double a, double b, double x) {
  if (!(x > 0.0)) return 0.0;
  if (!(x < 1.0)) return 1.0;
  if (x > (a + 1.0) / (a + b + 2.0)) return 1.0 - beta_regularised(b, a, 1.0 - x);
  const double front =
      std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x)) / a;
  ContinuedFraction f(1.0);
  for (int m = 0; m < kMaxTerms; ++m) {
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
    const double even = (m + 1.0) * (b - m - 1.0) * x / ((a + 2.0 * m + 1.0) * (a + 2.0 * m + 2.0));
    f.step(odd, 1.0);
    if (f.step(even, 1.0)) break;
  }
  return front / f.value;
}

double normal_sf(double z) { return 0.5 * std::erfc(z * std::sqrt(0.5)); }
double normal_two_sided(double z) { return std::erfc(std::abs(z) * std::sqrt(0.5)); }

double student_t_two_sided(double t, double dof) {
  if (std::isinf(t)) return 0.0;
  return beta_regularised(0.5 * dof, 0.5, dof / (dof + t * t));
}
double student_t_sf(double t, double dof) {
  const double tail = 0.5 * student_t_two_sided(t, dof);
  return t >= 0.0 ? tail : 1.0 - tail;
}

double chi_square_sf(double x, double dof) { return dof > 0.0 ? gamma_q(0.5 * dof, 0.5 * x) : 1.0; }

double sidak_level(double family, uint64_t tests) {
  return tests == 0 ? family : -std::expm1(std::log1p(-family) / static_cast<double>(tests));
}
double bonferroni_level(double family, uint64_t tests) {
  return tests == 0 ? family : family / static_cast<double>(tests);
}
double repeated_level(double family, uint64_t groups, uint64_t tests) {
  return bonferroni_level(std::sqrt(bonferroni_level(family, groups)), tests);
}
double sidak_combined(double smallest_p, uint64_t tests) {
  if (smallest_p >= 1.0) return 1.0;
  return -std::expm1(static_cast<double>(tests) * std::log1p(-smallest_p));
}

std::vector<double> holm_corrected(std::span<const double> p_values) {
  std::vector<size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t i, size_t j) { return p_values[i] < p_values[j]; });
  std::vector<double> corrected(p_values.size());
  double largest = 0;
  for (size_t rank = 0; rank < order.size(); ++rank) {
    largest = std::max(largest, static_cast<double>(order.size() - rank) * p_values[order[rank]]);
    corrected[order[rank]] = std::min(largest, 1.0);
  }
  return corrected;
}

// The sum of the tail is an incomplete beta function (Abramowitz and Stegun 26.5.24).
double binomial_at_least(double k, double n, double p) {
  if (k <= 0) return 1.0;
  return k > n ? 0.0 : beta_regularised(k, n - k + 1, p);
}

void RunningStats::add(double x) {
  ++count_;
  const double delta = x - mean_;
  mean_ += delta / static_cast<double>(count_);
  m2_ += delta * (x - mean_);
}

// Two groups of numbers are merged as Chan, Golub and LeVeque 1979 do, one of them being all zeros.
void RunningStats::add_zeros(uint64_t times) {
  if (times == 0) return;
  const double n = static_cast<double>(count_), zeros = static_cast<double>(times);
  m2_ += mean_ * mean_ * n * zeros / (n + zeros);
  mean_ *= n / (n + zeros);
  count_ += times;
}

TestResult t_test(const RunningStats& sample, double expected) {
  const double variance = sample.variance_of_mean(), difference = sample.mean() - expected;
  if (variance == 0.0)
    return difference == 0.0 ? TestResult{}
                             : TestResult{std::copysign(std::numeric_limits<double>::infinity(), difference), 0.0, 0.0};
  TestResult result;
  result.statistic = difference / std::sqrt(variance);
  result.dof = static_cast<double>(sample.count() - 1);
  result.p_value = student_t_two_sided(result.statistic, result.dof);
  return result;
}

TestResult welch_test(const RunningStats& a, const RunningStats& b) { return welch_test(a.estimate(), b.estimate()); }

TestResult welch_test(const MeanEstimate& a, const MeanEstimate& b) {
  const double va = a.variance_of_mean, vb = b.variance_of_mean, difference = a.mean - b.mean;
  TestResult result;
  if (va + vb == 0.0) {
    if (difference != 0.0) result = {std::copysign(std::numeric_limits<double>::infinity(), difference), 0.0, 0.0};
    return result;
  }
  const auto part = [](double v, uint64_t n) { return v > 0.0 ? v * v / static_cast<double>(n - 1) : 0.0; };
  result.statistic = difference / std::sqrt(va + vb);
  result.dof = (va + vb) * (va + vb) / (part(va, a.count) + part(vb, b.count));
  result.p_value = student_t_two_sided(result.statistic, result.dof);
  return result;
}

bool would_be_seen(double relative, double mean, double standard_error, double dof, double level) {
  constexpr double kNinthDecile = 1.2816;  // of the normal distribution
  if (standard_error == 0.0) return true;
  const double t = relative * std::abs(mean) / standard_error - kNinthDecile;
  return t > 0.0 && student_t_two_sided(t, dof) < level;
}

TestResult chi_square_test(std::span<const double> observed, std::span<const double> expected, double min_expected) {
  std::vector<size_t> order(expected.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t i, size_t j) { return expected[i] < expected[j]; });

  struct Pool {
    double observed = 0, expected = 0;
  };
  std::vector<Pool> pools;
  Pool open;
  for (size_t i : order) {
    open.observed += observed[i];
    open.expected += expected[i];
    if (open.expected < min_expected) continue;
    pools.push_back(open);
    open = {};
  }
  if (open.expected > 0.0 || open.observed > 0.0) {
    if (pools.empty()) pools.emplace_back();
    pools.back().observed += open.observed;
    pools.back().expected += open.expected;
  }

  TestResult result;
  for (const Pool& p : pools)
    result.statistic += p.expected > 0.0 ? (p.observed - p.expected) * (p.observed - p.expected) / p.expected
                                         : (p.observed > 0.0 ? std::numeric_limits<double>::infinity() : 0.0);
  result.dof = pools.empty() ? 0.0 : static_cast<double>(pools.size() - 1);
  result.p_value = std::isinf(result.statistic) ? 0.0 : chi_square_sf(result.statistic, result.dof);
  return result;
}

}  // namespace etd
