// The filters: normalisation, supports, and that samples with their weights are distributed as the filter says, also
// for gaussians that are much narrower or wider than their radius.
#include "filters/filter.h"

#include <gtest/gtest.h>

#include "model_uses.h"

namespace etd {
namespace {

Filter filter(const std::string& model, double rx, double ry, double sigma = 0) {
  ModelUse use = use_of(model, {number("xradius", rx), number("yradius", ry)});
  if (sigma > 0) use.params.push_back(number("sigma", sigma));
  Diagnostics diagnostics;
  for (const ModelDecl* decl : filter_models())
    if (decl->name == model) check_params(*decl, use, diagnostics);
  const Filter f = make_filter(use, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << diagnostics.format_all();
  return f;
}

struct Case {
  const char* model;
  double rx, ry, sigma;
};

const Case kCases[] = {{"box", 0.5, 0.5, 0},         {"box", 2, 0.25, 0},           {"triangle", 2, 2, 0},
                       {"triangle", 0.7, 1.9, 0},    {"gaussian", 1.5, 1.5, 0.5},   {"gaussian", 2, 0.7, 0.8},
                       {"gaussian", 1.5, 1.5, 1e-3}, {"gaussian", 1.5, 2, 1e4},     {"gaussian", 1e-6, 1e-6, 1e6},
                       {"gaussian", 1e6, 1e6, 1e-6}, {"gaussian", 0.5, 0.5, 0.125}, {"gaussian", 6, 6, 1}};

// Half width of what is not zero to seven digits.
double extent(double radius, double sigma) { return sigma > 0 ? std::min(radius, 7 * sigma) : radius; }

TEST(Filter, IntegratesToOne) {
  for (const Case& c : kCases) {
    const Filter f = filter(c.model, c.rx, c.ry, c.sigma);
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
    const Filter f = filter(c.model, c.rx, c.ry, c.sigma);
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
    const Filter f = filter(c.model, c.rx, c.ry, c.sigma);
    for (const float ux : ends)
      for (const float uy : ends) {
        const FilterSample s = f.sample({ux, uy});
        EXPECT_LE(std::abs(s.offset.x), f.radius().x) << c.model << ' ' << ux;
        EXPECT_LE(std::abs(s.offset.y), f.radius().y) << c.model << ' ' << uy;
        EXPECT_TRUE(s.weight >= 0 && s.weight < 4) << c.model << ' ' << c.sigma << ' ' << ux << ' ' << s.weight;
        // Left of the middle comes from the left half of the unit interval.
        EXPECT_TRUE(ux < 0.5f ? s.offset.x <= 0 : s.offset.x >= 0);
      }
  }
}

// Over a fine grid of the unit square: weights average to 1 and stay near it, and the weighted second moment is that of
// the filter.
TEST(Filter, WeightsAndMoments) {
  for (const Case& c : kCases) {
    const Filter f = filter(c.model, c.rx, c.ry, c.sigma);
    constexpr int kSteps = 512;
    double mean = 0, first = 0, second = 0, far_off = 0;
    for (int i = 0; i < kSteps; ++i)
      for (int j = 0; j < kSteps; ++j) {
        const FilterSample s =
            f.sample({(static_cast<float>(i) + 0.5f) / kSteps, (static_cast<float>(j) + 0.5f) / kSteps});
        mean += s.weight;
        first += s.weight * double(s.offset.x);
        second += s.weight * double(s.offset.x) * s.offset.x;
        far_off += std::abs(s.weight - 1) > 0.02f;
      }
    const double n = double(kSteps) * kSteps, w = extent(c.rx, c.sigma);
    double expected = 0;  // by midpoints of the marginal, which is the filter along y = 0 up to a factor
    double norm = 0;
    for (int i = 0; i < 4096; ++i) {
      const double x = (i + 0.5 - 2048) / 2048 * w, v = f.eval({static_cast<float>(x), 0});
      expected += v * x * x;
      norm += v;
    }
    expected /= norm;
    EXPECT_NEAR(mean / n, 1.0, 1e-3) << c.model << ' ' << c.rx << ' ' << c.sigma;
    EXPECT_NEAR(first / n / w, 0.0, 1e-5) << c.model << ' ' << c.rx << ' ' << c.sigma;
    EXPECT_NEAR(second / n / expected, 1.0, 5e-3) << c.model << ' ' << c.rx << ' ' << c.sigma;
    EXPECT_LT(far_off / n, 0.01) << c.model << ' ' << c.rx << ' ' << c.sigma;
    if (std::string(c.model) != "gaussian") {
      EXPECT_EQ(mean, n);
    }
  }
}

// Each stretch of the unit interval carries the filter's integral over the offsets that it is sent to.
TEST(Filter, WeightedSamplesFollowTheFilter) {
  for (const Case& c : kCases) {
    if (c.rx != c.ry) continue;
    const Filter f = filter(c.model, c.rx, c.ry, c.sigma);
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
      EXPECT_NEAR(weighted / kStretches / (integral * (x1 - x0)), 1.0, 5e-3)
          << c.model << ' ' << c.rx << ' ' << c.sigma << " stretch " << k;
    }
  }
}

TEST(Filter, ClosedForms) {
  const Filter box = filter("box", 0.5, 0.5);
  EXPECT_EQ(box.sample({0.25f, 0.75f}).offset, (Vec2{-0.25f, 0.25f}));
  EXPECT_EQ(box.eval({0.49f, -0.49f}), 1.0f);
  const Filter triangle = filter("triangle", 2, 1);
  EXPECT_FLOAT_EQ(triangle.eval({1, 0.5f}), 0.125f);
  EXPECT_FLOAT_EQ(triangle.sample({0.125f, 0.5f}).offset.x, -1.0f);  // a quarter of a half lies beyond the middle
  // Wider than its radius, the lowered gaussian is a parabola: 9/16 (1 - x^2) (1 - y^2) on the square of half width 1.
  const Filter wide = filter("gaussian", 1, 1, 1e5);
  EXPECT_NEAR(wide.eval({0, 0}), 0.5625f, 1e-6f);
  EXPECT_NEAR(wide.eval({0.5f, 0.8f}), 0.5625f * 0.75f * 0.36f, 1e-6f);
}

TEST(Filter, UnknownNamesAreGaussians) {
  Diagnostics diagnostics;
  EXPECT_EQ(make_filter(use_of("mitchell"), diagnostics).radius(), (Vec2{1.5f, 1.5f}));
  EXPECT_EQ(filter_models().size(), 3u);
}

}  // namespace
}  // namespace etd
