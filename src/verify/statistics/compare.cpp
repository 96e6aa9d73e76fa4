#include "verify/statistics/compare.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "core/math.h"

namespace etd {
namespace {

// What rounding to floats in a file does to a value, relative, with a margin: no difference.
constexpr double kRounding = 1e-6;
// The verdict's level is divided evenly among the whole image, the blocks and the histograms.
constexpr double kGroups = 3;
// The p-values of the histogram that are below each of these are counted.
constexpr double kThresholds[] = {0.001, 0.01, 0.05, 0.1, 0.2, 0.4};

struct Moment {
  double mean = 0, variance = 0, dof = std::numeric_limits<double>::infinity();  // of the mean over a region
};

class Comparison {
 public:
  Comparison(const Estimate& a, const Estimate& b, const CompareOptions& options)
      : a_(a), b_(b), options_(options), correlated_(a.correlated || b.correlated), usable_(a.mean.size()) {
    for (size_t i = 0; i < usable_.size(); ++i) usable_[i] = is_finite(a_, i) && is_finite(b_, i);
  }

  bool correlated() const { return correlated_; }
  RegionTest test(const PixelBounds& region, int channel) const;
  void count_not_finite(Verdict& verdict) const;

 private:
  static bool is_finite(const Estimate& e, size_t i) {
    double sum = 0;
    for (size_t c = 0; c < 3; ++c) sum += e.mean[i][c] + e.variance[i][c];
    return std::isfinite(sum);
  }
  template <class F>
  size_t for_each_pixel(const PixelBounds& region, F&& f) const;
  Moment moment(const Estimate& e, const PixelBounds& region, size_t channel) const;

  const Estimate& a_;
  const Estimate& b_;
  const CompareOptions& options_;
  bool correlated_;
  std::vector<char> usable_;
};

// Calls f with the index of each usable pixel, and returns how many there are.
template <class F>
size_t Comparison::for_each_pixel(const PixelBounds& region, F&& f) const {
  size_t count = 0;
  for (int y = region.y0; y < region.y1; ++y)
    for (int x = region.x0; x < region.x1; ++x) {
      const size_t i = static_cast<size_t>(y) * static_cast<size_t>(a_.width) + static_cast<size_t>(x);
      if (!usable_[i]) continue;
      f(i);
      ++count;
    }
  return count;
}

// Independent pixels: the sum of their variances, with the degrees of freedom of Satterthwaite (1946). Correlated ones:
// the spread of the replicates' means.
Moment Comparison::moment(const Estimate& e, const PixelBounds& region, size_t c) const {
  Moment m;
  if (e.dof == std::numeric_limits<double>::infinity() || !correlated_) {
    double sum = 0, variance = 0, squares = 0;
    const double n = static_cast<double>(for_each_pixel(region, [&](size_t i) {
      sum += e.mean[i][c];
      variance += e.variance[i][c];
      squares += sqr(e.variance[i][c]);
    }));
    if (n == 0) return m;
    m.mean = sum / n;
    m.variance = variance / (n * n);
    if (squares > 0) m.dof = e.dof * variance * variance / squares;
    return m;
  }
  RunningStats stats;
  for (const std::vector<Rgb>& replicate : e.replicates) {
    double sum = 0;
    const size_t n = for_each_pixel(region, [&](size_t i) { sum += replicate[i][c]; });
    stats.add(n > 0 ? sum / static_cast<double>(n) : 0.0);
  }
  m.mean = stats.mean();
  m.variance = stats.variance_of_mean();
  m.dof = static_cast<double>(stats.count()) - 1;
  return m;
}

// Few samples that all missed a rare bright path believe in a small variance. If both images come from one method, the
// other's samples tell better; if they do not, the larger variance costs little power. Only the number of samples has
// to be known.
Moment with_floor(Moment own, const Moment& other, double own_samples, double other_samples) {
  if (own_samples <= 0 || other_samples <= 0) return own;
  const double expected = other.variance * other_samples / own_samples;
  if (own.variance < expected) own.variance = expected, own.dof = other.dof;
  return own;
}

RegionTest Comparison::test(const PixelBounds& region, int channel) const {
  const size_t c = static_cast<size_t>(channel);
  const Moment own_a = moment(a_, region, c), own_b = moment(b_, region, c);
  const Moment a = with_floor(own_a, own_b, a_.samples, b_.samples),
               b = with_floor(own_b, own_a, b_.samples, a_.samples);
  RegionTest t;
  t.region = region, t.channel = channel;
  t.a = a.mean, t.b = b.mean;
  const double variance = a.variance + b.variance, difference = b.mean - a.mean;
  const double excess =
      std::abs(difference) - (options_.tolerance + kRounding) * std::max(std::abs(a.mean), std::abs(b.mean));
  t.error = std::sqrt(variance);
  if (variance == 0 && excess > 0) {
    t.result = {std::copysign(std::numeric_limits<double>::infinity(), difference), 0.0, 0.0};
  } else if (variance > 0) {
    t.result.statistic = std::copysign(std::max(excess, 0.0), difference) / t.error;
    t.result.dof = sqr(variance) / (sqr(a.variance) / a.dof + sqr(b.variance) / b.dof);
    t.result.p_value = student_t_two_sided(t.result.statistic, t.result.dof);
  }
  return t;
}

void Comparison::count_not_finite(Verdict& verdict) const {
  for (size_t i = 0; i < usable_.size(); ++i) {
    if (usable_[i]) continue;
    ++verdict.not_finite;
    verdict.not_finite_in_one |= is_finite(a_, i) != is_finite(b_, i);
  }
}

HistogramTest test_histogram(const std::vector<RegionTest>& blocks, int channel) {
  HistogramTest h;
  h.channel = channel;
  std::vector<double> values;
  for (const RegionTest& t : blocks)
    if (t.channel == channel) values.push_back(t.result.p_value);
  h.blocks = values.size();
  for (const double p : values)
    ++h.bins[std::min(static_cast<size_t>(p * HistogramTest::kBins), HistogramTest::kBins - 1)];
  const double n = static_cast<double>(values.size());
  for (const double threshold : kThresholds) {
    const auto below = std::count_if(values.begin(), values.end(), [threshold](double p) { return p < threshold; });
    const double k = static_cast<double>(below), p = binomial_at_least(k, n, threshold);
    if (h.threshold == 0 || p < h.p_value) h.p_value = p, h.threshold = threshold, h.below = static_cast<size_t>(below);
  }
  h.p_value = std::min(1.0, h.p_value * static_cast<double>(std::size(kThresholds)));
  return h;
}

template <class Test, class GetP>
void correct(std::vector<Test>& tests, GetP&& p_value, double& smallest) {
  std::vector<double> p;
  for (const Test& t : tests) p.push_back(p_value(t));
  const std::vector<double> corrected = holm_corrected(p);
  for (size_t i = 0; i < tests.size(); ++i) {
    tests[i].corrected = std::min(1.0, kGroups * corrected[i]);
    smallest = std::min(smallest, tests[i].corrected);
  }
}

}  // namespace

Verdict compare(const Estimate& a, const Estimate& b, const CompareOptions& options) {
  assert(a.width == b.width && a.height == b.height);
  const Comparison comparison(a, b, options);
  Verdict v;
  v.level = options.level;
  comparison.count_not_finite(v);
  for (int c = 0; c < 3; ++c) {
    v.image.push_back(comparison.test({0, 0, a.width, a.height}, c));
    for (int y = 0; y < a.height; y += options.block)
      for (int x = 0; x < a.width; x += options.block) {
        const RegionTest t =
            comparison.test({x, y, std::min(x + options.block, a.width), std::min(y + options.block, a.height)}, c);
        if (t.error == 0 && t.result.p_value == 1)
          ++v.left_out;
        else
          v.blocks.push_back(t);
      }
    if (!comparison.correlated())
      if (HistogramTest h = test_histogram(v.blocks, c); h.blocks > 0) v.histograms.push_back(h);
  }
  const auto of_region = [](const RegionTest& t) { return t.result.p_value; };
  correct(v.image, of_region, v.p_value);
  correct(v.blocks, of_region, v.p_value);
  correct(
      v.histograms, [](const HistogramTest& h) { return h.p_value; }, v.p_value);
  v.same = v.p_value >= options.level && !v.not_finite_in_one;
  return v;
}

}  // namespace etd
