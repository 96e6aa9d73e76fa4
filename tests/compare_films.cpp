#include "compare_films.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace etd {
namespace {

constexpr int kBlock = 8;
const char* const kQuantities[] = {"beauty.R", "beauty.G", "beauty.B", "direct", "indirect"};
constexpr size_t kChannels = 3;  // the first of them

double percent(const RunningStats& s) { return 100 * std::sqrt(s.variance_of_mean()) / s.mean(); }

}  // namespace

uint64_t film_test_count(int width, int height) {
  const auto blocks = [](int n) { return static_cast<uint64_t>((n + kBlock - 1) / kBlock); };
  return std::size(kQuantities) + blocks(width) * blocks(height);
}

std::vector<FilmTest> compare_films(const Film& a, const Film& b, double planted) {
  std::vector<FilmTest> tests;
  const auto add = [&](std::string what, const PixelBounds& region, const Quantity& q) {
    const RunningStats sa = region_mean(a, region, q), sb = region_mean(b, region, q, planted);
    tests.push_back({std::move(what), sa, sb, welch_test(sa, sb)});
  };
  const PixelBounds& all = a.settings().crop;
  for (const char* q : kQuantities) add(fmt::format("image, {}", q), all, *parse_quantity(q));
  for (int y = all.y0; y < all.y1; y += kBlock)
    for (int x = all.x0; x < all.x1; x += kBlock)
      add(fmt::format("block {},{}", x, y), {x, y, std::min(x + kBlock, all.x1), std::min(y + kBlock, all.y1)}, {});
  return tests;
}

bool films_agree(const Film& a, const Film& b, double level) {
  const std::vector<FilmTest> tests = compare_films(a, b);
  return std::all_of(tests.begin(), tests.end(), [level](const FilmTest& t) { return t.result.p_value >= level; });
}

void expect_agreement(const std::string& name, const Film& a, const Film& b, double level) {
  ASSERT_EQ(a.settings().crop, b.settings().crop);
  const std::vector<FilmTest> tests = compare_films(a, b);
  bool agree = true;
  for (const FilmTest& t : tests) {
    EXPECT_GE(t.result.p_value, level) << fmt::format("{}, {}: {:.6f} and {:.6f}, {:+.3f} %, t = {:.2f}", name, t.what,
                                                      t.a.mean(), t.b.mean(), 100 * (t.b.mean() / t.a.mean() - 1),
                                                      t.result.statistic);
    agree &= t.result.p_value >= level;
  }
  if (!agree)
    ADD_FAILURE() << write_evidence("agreement", a.settings().crop.width(), a.settings().crop.height(), picture(b),
                                    picture(a));
  for (size_t i = 0; i < kChannels; ++i) {
    const FilmTest& t = tests[i];
    const double error = std::sqrt(t.a.variance_of_mean() + t.b.variance_of_mean());
    EXPECT_TRUE(would_be_seen(0.01, t.a.mean(), error, t.result.dof, level))
        << fmt::format("{}, {}: standard errors {:.3f} % and {:.3f} %, too few samples to see an error of 1 %", name,
                       t.what, percent(t.a), percent(t.b));
  }
}

}  // namespace etd
