#include "expect_agreement.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace etd {
namespace {

double percent(const RunningStats& s) { return 100 * std::sqrt(s.variance_of_mean()) / s.mean(); }

void expect_sharp(const std::string& name, const std::vector<FilmTest>& tests, double level, double visible) {
  for (size_t i = 0; i < kImageChannelTests; ++i) {
    const FilmTest& t = tests[i];
    const double error = std::sqrt(t.a.variance_of_mean() + t.b.variance_of_mean());
    EXPECT_TRUE(would_be_seen(visible, t.a.mean(), error, t.result.dof, level))
        << fmt::format("{}, {}: standard errors {:.3f} % and {:.3f} %, too few samples to see an error of {} %", name,
                       t.what, percent(t.a), percent(t.b), 100 * visible);
  }
}

}  // namespace

std::vector<FilmTest> expect_agreement(const std::string& name, double level,
                                       const std::function<std::pair<Film, Film>(const TestRun&)>& films,
                                       double visible) {
  std::vector<FilmTest> tests;
  expect_in_two_runs(name, [&](const TestRun& run) {
    const auto [a, b] = films(run);
    EXPECT_EQ(a.settings().crop, b.settings().crop);
    tests = compare_films(a, b);
    if (run.is_first()) expect_sharp(name, tests, level, visible);
    Objections objections;
    for (const FilmTest& t : tests)
      if (t.result.p_value < level)
        objections.push_back(fmt::format("{}: {:.6f} and {:.6f}, {:+.3f} %, t = {:.2f}", t.what, t.a.mean(), t.b.mean(),
                                         100 * (t.b.mean() / t.a.mean() - 1), t.result.statistic));
    if (!run.is_first() && !objections.empty())
      objections.push_back(
          write_evidence("agreement", a.settings().crop.width(), a.settings().crop.height(), picture(b), picture(a)));
    return objections;
  });
  return tests;
}

}  // namespace etd
