// The filters: normalisation, supports, and that samples with their weights are distributed as the filter says, also
// for gaussians that are much narrower or wider than their radius.
#include "filters/filter.h"

#include <gtest/gtest.h>

#include "core/hash.h"
#include "model_uses.h"
#include "verify/statistics/statistics.h"

namespace etd {
namespace {

struct Case {
  const char* model;
  double rx, ry, sigma = 0;
  std::vector<Param> more = {};
};

Filter filter(const Case& c) {
  ModelUse use = use_of(c.model, {number("xradius", c.rx), number("yradius", c.ry)});
  if (c.sigma > 0) use.params.push_back(number("sigma", c.sigma));
  use.params.insert(use.params.end(), c.more.begin(), c.more.end());
  Diagnostics diagnostics;
  for (const ModelDecl* decl : filter_models())
    if (decl->name == c.model) check_params(*decl, use, diagnostics);
  const Filter f = make_filter(use, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << diagnostics.format_all();
  return f;
}

const Case kCases[] = {{"box", 0.5, 0.5},
                       {"box", 2, 0.25},
                       {"triangle", 2, 2},
                       {"triangle", 0.7, 1.9},
                       {"gaussian", 1.5, 1.5, 0.5},
                       {"gaussian", 2, 0.7, 0.8},
                       {"gaussian", 1.5, 1.5, 1e-3},
                       {"gaussian", 1.5, 2, 1e4},
                       {"gaussian", 1e-6, 1e-6, 1e6},
                       {"gaussian", 1e6, 1e6, 1e-6},
                       {"gaussian", 0.5, 0.5, 0.125},
                       {"gaussian", 6, 6, 1},
                       {"mitchell", 2, 2},
                       {"mitchell", 1.5, 3, 0, {number("B", 0), number("C", 0.5)}},
                       {"mitchell", 2, 2, 0, {number("B", 1), number("C", 0)}},
                       {"mitchell", 2, 2, 0, {number("B", -1), number("C", 2)}},
                       {"sinc", 4, 4},
                       {"sinc", 3, 3},
                       {"sinc", 2.5, 8, 0, {number("tau", 2)}},
                       {"sinc", 32, 32, 0, {number("tau", 32)}}};

bool is_signed(const Case& c) { return std::string(c.model) == "mitchell" || std::string(c.model) == "sinc"; }

// Half width of what is not zero to seven digits.
double extent(double radius, double sigma) { return sigma > 0 ? std::min(radius, 7 * sigma) : radius; }

TEST(Filter, IntegratesToOne) {
  for (const Case& c : kCases) {
    const Filter f = filter(c);
    constexpr int kSteps = 512;
    const double w = 2 * extent(c.rx, c.sigma) / kSteps, h = 2 * extent(c.ry, c.sigma) / kSteps;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
      for (int j = 0; j < kSteps; ++j)
        sum += w * h *
               f.eval({static_cast<float>((i + 0.5 - kSteps / 2) * w), static_cast<float>((j + 0.5 - kSteps / 2) * h)});
    EXPECT_NEAR(sum, 1.0, 2e-5) << c.model << ' ' << c.rx << ' ' << c.sigma;
  }
}

TEST(Filter, IsZeroBeyondItsRadius) {
  for (const Case& c : kCases) {
    const Filter f = filter(c);
    EXPECT_EQ(f.radius(), (Vec2{static_cast<float>(c.rx), static_cast<float>(c.ry)}));
    EXPECT_EQ(f.eval({static_cast<float>(c.rx * 1.001), 0}), 0.0f);
    EXPECT_EQ(f.eval({0, static_cast<float>(-c.ry * 1.001)}), 0.0f);
    EXPECT_GT(f.eval({0, 0}), 0.0f);
    EXPECT_EQ(f.eval({static_cast<float>(extent(c.rx, c.sigma) / 3), 0}),
              f.eval({static_cast<float>(-extent(c.rx, c.sigma) / 3), 0}));
  }
}

TEST(Filter, SamplesOfTheWholeRangeAreFiniteAndInside) {
  const float ends[] = {0.0f, 0x1p-24f, 0.25f, 0.5f - 0x1p-25f, 0.5f, 0.5f + 0x1p-24f, 0.75f, kOneMinusEpsilon};
  for (const Case& c : kCases) {
    const Filter f = filter(c);
    for (const float ux : ends)
      for (const float uy : ends) {
        const FilterSample s = f.sample({ux, uy});
        EXPECT_LE(std::abs(s.offset.x), f.radius().x) << c.model << ' ' << ux;
        EXPECT_LE(std::abs(s.offset.y), f.radius().y) << c.model << ' ' << uy;
        EXPECT_TRUE(std::abs(s.weight) < 16 && (s.weight >= 0 || is_signed(c)))
            << c.model << ' ' << c.sigma << ' ' << ux << ' ' << s.weight;
        // Left of the middle comes from the left half of the unit interval.
        EXPECT_TRUE(ux < 0.5f ? s.offset.x <= 0 : s.offset.x >= 0);
      }
  }
}

// The weight of a sample is a product of one for each axis, so lines through the unit square say all: weights average
// to 1, are no larger than they must be, and the weighted moments are those of the filter.
TEST(Filter, WeightsAndMoments) {
  constexpr int kSteps = 1 << 16;
  for (const Case& c : kCases) {
    const Filter f = filter(c);
    const double middle = f.sample({0.5f, 0.5f}).weight;
    double mean[2] = {0, 0}, size[2] = {0, 0}, first = 0, second = 0;
    for (int i = 0; i < kSteps; ++i) {
      const float u = (static_cast<float>(i) + 0.5f) / kSteps;
      const FilterSample line[] = {f.sample({u, 0.5f}), f.sample({0.5f, u})};
      for (size_t k = 0; k < 2; ++k) {
        mean[k] += double{line[k].weight} / kSteps;
        size[k] += std::abs(double{line[k].weight}) / kSteps;
      }
      const double x = line[0].offset.x;
      first += line[0].weight * x / kSteps;
      second += line[0].weight * x * x / kSteps;
    }
    double norm[2] = {0, 0}, sizes[2] = {0, 0}, expected = 0, scale = 0;  // by midpoints along the axes
    constexpr int kPoints = 8192;
    const double w = extent(c.rx, c.sigma), h = extent(c.ry, c.sigma);
    for (int i = 0; i < kPoints; ++i) {
      const double t = (i + 0.5) / (kPoints / 2) - 1, x = t * w;
      const double v[] = {f.eval({static_cast<float>(x), 0}), f.eval({0, static_cast<float>(t * h)})};
      for (size_t k = 0; k < 2; ++k) {
        norm[k] += v[k];
        sizes[k] += std::abs(v[k]);
      }
      expected += v[0] * x * x;
      scale += std::abs(v[0]) * x * x;
    }
    EXPECT_NEAR(mean[0] * mean[1] / middle, 1.0, 1e-3) << c.model << ' ' << c.rx << ' ' << c.sigma;
    EXPECT_NEAR(first / mean[0] / w, 0.0, 1e-4) << c.model << ' ' << c.rx << ' ' << c.sigma;
    EXPECT_NEAR(second / mean[0], expected / norm[0], 5e-3 * scale / norm[0])
        << c.model << ' ' << c.rx << ' ' << c.sigma;
    for (size_t k = 0; k < 2; ++k)
      EXPECT_NEAR(size[k] / mean[k] / (sizes[k] / norm[k]), 1.0, 5e-3) << c.model << ' ' << c.rx << ' ' << c.sigma;
    if (std::string(c.model) == "box" || std::string(c.model) == "triangle") {
      EXPECT_EQ(size[0], 1.0);
    }
  }
}

// Each stretch of the unit interval carries the filter's integral over the offsets that it is sent to.
TEST(Filter, WeightedSamplesFollowTheFilter) {
  for (const Case& c : kCases) {
    if (c.rx != c.ry) continue;
    const Filter f = filter(c);
    const double root = std::sqrt(double(f.eval({0, 0})));
    const float middle_weight = f.sample({0.5f, 0.5f}).weight;
    constexpr int kStretches = 50, kSteps = 400;
    for (int k = 0; k < kStretches; ++k) {
      const float lo = static_cast<float>(k) / kStretches, hi = std::min(lo + 1.0f / kStretches, kOneMinusEpsilon);
      double weighted = 0, integral = 0;
      const double x0 = f.sample({lo, 0.5f}).offset.x, x1 = f.sample({hi, 0.5f}).offset.x;
      if (k == 0 || k == kStretches - 1) continue;  // reach to the radius, where rounding of u cuts them short
      for (int i = 0; i < kSteps; ++i) {
        const double t = (i + 0.5) / kSteps;
        weighted += f.sample({static_cast<float>(lo + t * (hi - lo)), 0.5f}).weight / std::sqrt(middle_weight);
        integral += f.eval({static_cast<float>(x0 + t * (x1 - x0)), 0}) / root;
      }
      const double size = is_signed(c) ? 1.0 / kStretches : integral * (x1 - x0) / kSteps;
      EXPECT_NEAR((weighted / kStretches - integral * (x1 - x0)) / kSteps / size, 0.0, 5e-3)
          << c.model << ' ' << c.rx << ' ' << c.sigma << " stretch " << k;
    }
  }
}

// Counts of samples in cells against the integral of the filter's absolute value there. The tables that samples come
// from are off by less than a hundredth where it matters, which adds less than 3 to a chi-square of several hundred.
// False alarms of all cases together: below 1e-4.
TEST(StatisticalFilter, SamplesFollowTheAbsoluteValue) {
  constexpr int kCells = 20, kFine = 16, kSamples = 40000;
  for (const Case& c : kCases) {
    const Filter f = filter(c);
    const double w = extent(c.rx, c.sigma), h = extent(c.ry, c.sigma);
    std::vector<double> observed(kCells * kCells), expected(kCells * kCells);
    HashStream numbers(3);
    const auto cell = [](double t) { return std::clamp(static_cast<int>((t + 1) / 2 * kCells), 0, kCells - 1); };
    for (int i = 0; i < kSamples; ++i) {
      const float u = numbers.next_float();
      const Vec2 o = f.sample({u, numbers.next_float()}).offset;
      ++observed[static_cast<size_t>(cell(o.y / h) * kCells + cell(o.x / w))];
    }
    double total = 0;
    for (int i = 0; i < kCells * kFine; ++i)
      for (int j = 0; j < kCells * kFine; ++j) {
        const auto at = [](int k) { return 2 * (k + 0.5) / (kCells * kFine) - 1; };
        const double v = std::abs(f.eval({static_cast<float>(at(j) * w), static_cast<float>(at(i) * h)}));
        expected[static_cast<size_t>(i / kFine * kCells + j / kFine)] += v;
        total += v;
      }
    for (double& e : expected) e *= kSamples / total;
    const TestResult test = chi_square_test(observed, expected, 5);
    EXPECT_GT(test.p_value, bonferroni_level(1e-4, std::size(kCases)))
        << c.model << ' ' << c.rx << ' ' << c.sigma << ": chi-square " << test.statistic << " of " << test.dof;
  }
}

TEST(Filter, ClosedForms) {
  const Filter box = filter({"box", 0.5, 0.5});
  EXPECT_EQ(box.sample({0.25f, 0.75f}).offset, (Vec2{-0.25f, 0.25f}));
  EXPECT_EQ(box.eval({0.49f, -0.49f}), 1.0f);
  const Filter triangle = filter({"triangle", 2, 1});
  EXPECT_FLOAT_EQ(triangle.eval({1, 0.5f}), 0.125f);
  EXPECT_FLOAT_EQ(triangle.sample({0.125f, 0.5f}).offset.x, -1.0f);  // a quarter of a half lies beyond the middle
  // Wider than its radius, the lowered gaussian is a parabola: 9/16 (1 - x^2) (1 - y^2) on the square of half width 1.
  const Filter wide = filter({"gaussian", 1, 1, 1e5});
  EXPECT_NEAR(wide.eval({0, 0}), 0.5625f, 1e-6f);
  EXPECT_NEAR(wide.eval({0.5f, 0.8f}), 0.5625f * 0.75f * 0.36f, 1e-6f);
  // Mitchell and Netravali's at half width 2: (6 - 2 B)/6 in the middle, B/6 at 1, negative beyond; the Catmull-Rom
  // spline is 1 in the middle and 0 at the other pixels.
  const Filter mitchell = filter({"mitchell", 2, 2});
  EXPECT_NEAR(mitchell.eval({0, 0}), sqr(8.0f / 9), 1e-6f);
  EXPECT_NEAR(mitchell.eval({1, 0}), 8.0f / 9 / 18, 1e-6f);
  EXPECT_LT(mitchell.eval({1.5f, 0}), 0.0f);
  const Filter spline = filter({"mitchell", 2, 2, 0, {number("B", 0), number("C", 0.5)}});
  EXPECT_NEAR(spline.eval({0, 0}), 1.0f, 1e-6f);
  EXPECT_NEAR(spline.eval({1, 0}), 0.0f, 1e-6f);
  EXPECT_NEAR(spline.eval({0.5f, 0}), 0.5625f, 1e-6f);
  // Zero at the other pixels, and at tau; the ratio of two values needs no integral.
  const Filter sinc = filter({"sinc", 4, 4});
  EXPECT_NEAR(sinc.eval({2, 0}), 0.0f, 1e-6f);
  EXPECT_NEAR(sinc.eval({0.5f, 0}) / sinc.eval({0, 0}), 2 / kPi * 3 / kPi, 1e-6f);
  EXPECT_LT(sinc.eval({1.5f, 0}), 0.0f);
}

TEST(Filter, UnknownNamesAreGaussians) {
  Diagnostics diagnostics;
  EXPECT_EQ(make_filter(use_of("lanczos"), diagnostics).radius(), (Vec2{1.5f, 1.5f}));
  EXPECT_EQ(filter_models().size(), 5u);
}

}  // namespace
}  // namespace etd
