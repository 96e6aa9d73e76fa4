// The openings of lenses: where their samples fall, against the shapes they stand for.
#include "cameras/aperture.h"

#include <gtest/gtest.h>

#include <functional>

#include "cameras/perspective.h"
#include "core/hash.h"
#include "model_uses.h"
#include "render_helper.h"
#include "verify/statistics/statistics.h"

namespace etd {
namespace {

struct Made {
  Aperture aperture;
  std::string problems;
};

Made make(std::vector<Param> params, CameraData& data) {
  Diagnostics diagnostics;
  const ModelUse use = use_of("perspective", std::move(params));
  check_params(PerspectiveCamera::decl(), use, diagnostics);
  const ParamReader reader(PerspectiveCamera::decl(), use, diagnostics);
  const Aperture a = Aperture::create(reader, {source_path("tests/scenes/closed/parts")}, data);
  return {a, diagnostics.format_all()};
}

Param integer(const std::string& name, int value) {
  Param p;
  p.name = name;
  p.kind = ParamKind::kInteger;
  p.integers = {value};
  return p;
}

// Whether (x, y) lies in the regular polygon whose first corner, at `first` degrees, is at distance r.
bool in_polygon(double x, double y, int corners, double r, double first) {
  for (int i = 0; i < corners; ++i) {
    const double middle = (first + 360.0 * (i + 0.5) / corners) * kPiD / 180;
    if (x * std::cos(middle) + y * std::sin(middle) > r * std::cos(kPiD / corners)) return false;
  }
  return true;
}

struct Case {
  const char* name;
  std::vector<Param> params;
  std::function<double(double, double)> density;  // up to a factor
};

std::vector<Case> cases() {
  const auto square = [](double x, double y) { return std::max(std::abs(x), std::abs(y)) <= 0.5 ? 1.0 : 0.0; };
  return {{"round", {}, [](double x, double y) { return x * x + y * y <= 1 ? 1.0 : 0.0; }},
          {"triangle", {integer("blades", 3)}, [](double x, double y) { return in_polygon(x, y, 3, 1, 90); }},
          {"six blades, turned",
           {integer("blades", 6), number("bladerotation", 20)},
           [](double x, double y) { return in_polygon(x, y, 6, 1, 110); }},
          {"square", {text("aperture", "square")}, square},
          {"square, turned",
           {text("aperture", "square"), number("bladerotation", 45)},
           [](double x, double y) { return std::abs(x) + std::abs(y) <= std::sqrt(0.5) ? 1.0 : 0.0; }},
          {"pentagon", {text("aperture", "pentagon")}, [](double x, double y) { return in_polygon(x, y, 5, 0.8, 90); }},
          // The pentagram: at least four of the five half planes that its long diagonals bound.
          {"star",
           {text("aperture", "star")},
           [](double x, double y) {
             int inside = 0;
             for (int i = 0; i < 5; ++i) {
               const double a = (90 + 72 * i) * kPiD / 180;
               inside += x * std::cos(a) + y * std::sin(a) <= std::cos(kPiD * 72 / 180);
             }
             return inside >= 4 ? 1.0 : 0.0;
           }},
          {"gaussian",
           {text("aperture", "gaussian")},
           [](double x, double y) { return std::max(0.0, std::exp(-x * x - y * y) - std::exp(-1.0)); }},
          {"image", {text("aperture", "corner_aperture.pfm")}, [](double x, double y) {
             return std::max(std::abs(x), std::abs(y)) > 1 ? 0.0 : y > 0 ? (x < 0 ? 1.0 : 0.0) : (x < 0 ? 2.0 : 1.0);
           }}};
}

// Counts in a grid of cells against the integral of the density. False alarms of all together: below 1e-4.
TEST(StatisticalAperture, SamplesFollowTheShape) {
  constexpr int kCells = 14, kFine = 40, kSamples = 100000;
  const std::vector<Case> all = cases();
  for (const Case& c : all) {
    CameraData data;
    const Made made = make(c.params, data);
    ASSERT_EQ(made.problems, "") << c.name;
    std::vector<double> observed(kCells * kCells), expected(kCells * kCells);
    const auto cell = [](double v) { return std::clamp(static_cast<int>((v + 1.05) / 2.1 * kCells), 0, kCells - 1); };
    HashStream numbers(11);
    for (int i = 0; i < kSamples; ++i) {
      const float u = numbers.next_float();
      const Vec2 p = made.aperture.sample({u, numbers.next_float()});
      ++observed[static_cast<size_t>(cell(p.y) * kCells + cell(p.x))];
    }
    double total = 0;
    for (int i = 0; i < kCells * kFine; ++i)
      for (int j = 0; j < kCells * kFine; ++j) {
        const auto at = [](int k) { return 2.1 * (k + 0.5) / (kCells * kFine) - 1.05; };
        const double d = c.density(at(j), at(i));
        expected[static_cast<size_t>(i / kFine * kCells + j / kFine)] += d;
        total += d;
      }
    for (double& e : expected) e *= kSamples / total;
    const TestResult test = chi_square_test(observed, expected, 5);
    EXPECT_GT(test.p_value, bonferroni_level(1e-4, all.size())) << c.name << ": chi-square " << test.statistic;
  }
}

// The told density is that of the shape, scaled to an integral of 1.
TEST(Aperture, DensityIsThatOfTheShape) {
  constexpr int kFine = 500;
  const auto at = [](int k) { return 2.2 * (k + 0.5) / kFine - 1.1; };
  for (const Case& c : cases()) {
    CameraData data;
    const Aperture a = make(c.params, data).aperture;
    double told = 0, total = 0, apart = 0;
    for (int i = 0; i < kFine * kFine; ++i) total += c.density(at(i % kFine), at(i / kFine));
    for (int i = 0; i < kFine * kFine; ++i) {
      const double x = at(i % kFine), y = at(i / kFine);
      const double density = a.density({static_cast<float>(x), static_cast<float>(y)}) * sqr(2.2 / kFine);
      told += density;
      apart += std::abs(density - c.density(x, y) / total);
    }
    EXPECT_NEAR(told, 1, 1e-2) << c.name;  // edges cut the squares of the sum
    EXPECT_LT(apart, 1e-2) << c.name;
  }
}

// The whole range of random numbers stays in the opening's circle (or an image's square).
TEST(Aperture, EdgesOfTheUnitSquare) {
  for (const Case& c : cases()) {
    CameraData data;
    const Aperture a = make(c.params, data).aperture;
    for (const float u : {0.0f, 0x1p-24f, 0.5f, kOneMinusEpsilon})
      for (const float v : {0.0f, 0x1p-24f, 0.5f, kOneMinusEpsilon}) {
        const Vec2 p = a.sample({u, v});
        EXPECT_LE(std::max(std::abs(p.x), std::abs(p.y)), 1.00001f) << c.name;
      }
  }
}

TEST(Aperture, WhatIsNoOpening) {
  CameraData data;
  EXPECT_NE(make({integer("blades", 2)}, data).problems.find("2 blades leave no opening"), std::string::npos);
  EXPECT_NE(make({text("aperture", "nowhere.pfm")}, data).problems.find("cannot read"), std::string::npos);
  EXPECT_NE(make({text("aperture", "star"), integer("blades", 5)}, data).problems.find("not both"), std::string::npos);
}

}  // namespace
}  // namespace etd
