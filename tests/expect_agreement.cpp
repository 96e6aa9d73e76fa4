#include "expect_agreement.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace etd {
namespace {
double percent(const RunningStats& s) { return 100 * std::sqrt(s.variance_of_mean()) / s.mean(); }
}  // namespace

std::vector<FilmTest> expect_agreement(const std::string& name, const Film& a, const Film& b, double level) {
  EXPECT_EQ(a.settings().crop, b.settings().crop);
  std::vector<FilmTest> tests = compare_films(a, b);
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
  for (size_t i = 0; i < kImageChannelTests; ++i) {
    const FilmTest& t = tests[i];
    const double error = std::sqrt(t.a.variance_of_mean() + t.b.variance_of_mean());
    EXPECT_TRUE(would_be_seen(0.01, t.a.mean(), error, t.result.dof, level))
        << fmt::format("{}, {}: standard errors {:.3f} % and {:.3f} %, too few samples to see an error of 1 %", name,
                       t.what, percent(t.a), percent(t.b));
  }
  return tests;
}

}  // namespace etd
