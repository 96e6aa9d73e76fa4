// Scenes whose answer is known in closed form, each in a file that derives it (scene_answers.h has their grammar):
// every mode in which a scene converges must give the answer with sobol samples, and its last mode (mis, where it can)
// with independent ones too, in one of two runs (second_run.h); the slow set takes both samplers in every mode.
// All t-tests together raise a false alarm with a probability of at most 1e-4, and each is sharp enough to see an error
// of 1 % in the first run, which is checked as well.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "scene_answers.h"
#include "second_run.h"

namespace etd {
namespace {

constexpr double kFamilyLevel = 1e-4;
constexpr double kRounding = 1e-5;  // relative error of float arithmetic along a path
constexpr uint32_t kReplicates = 32;

struct Case {
  const AnsweredScene* scene;
  std::string mode, sampler;
  uint32_t spp;
};

const std::vector<AnsweredScene>& scenes() {
  static const std::vector<AnsweredScene> all = answered_scenes(source_path("tests/scenes/closed"));
  return all;
}

bool is_quick(const Case& c) { return c.sampler == "sobol" || c.mode == c.scene->modes.back().name; }

std::vector<Case> all_cases() {
  std::vector<Case> all;
  for (const AnsweredScene& scene : scenes())
    for (const SceneMode& mode : scene.modes)
      for (const std::string sampler : {"independent", "sobol"})
        all.push_back({&scene, mode.name, sampler, sampler == "sobol" ? mode.spp_sobol : mode.spp});
  return all;
}

std::vector<Case> cases(bool quick) {
  std::vector<Case> some;
  for (const Case& c : all_cases())
    if (is_quick(c) == quick) some.push_back(c);
  return some;
}

// A fixed level for one test, so that a new scene does not change the verdict on the others. A case with n answers
// fails by chance with a probability of at most n kLevel in one run, and with (n kLevel)^2 in both.
constexpr double kLevel = 1e-4;

TEST(ClosedForms, AreNotTooManyForTheFamilyLevel) {
  double alarms = 0;
  for (const Case& c : all_cases()) alarms += sqr(static_cast<double>(c.scene->answers.size()) * kLevel);
  EXPECT_LE(alarms, kFamilyLevel);
}

Film render_case(const Case& c, uint64_t seed, uint32_t spp) {
  RenderOverrides o;
  o.spp = spp;
  o.replicates = kReplicates;
  o.seed = seed;
  o.sampler = c.sampler;
  o.tile_size = 2;
  o.features = false;
  o.set = {{"integrator.mode", c.mode}};
  return render_scene(c.scene->file, o);
}

RunningStats measure(const Film& film, const SceneAnswer& answer) {
  return region_mean(film, answer.region.value_or(film.settings().crop), answer.quantity);
}

// What rounding may have made of the answer.
double nearest_answer(const SceneAnswer& answer, double mean) {
  const double slack = std::abs(answer.value) * kRounding;
  return std::clamp(mean, answer.value - slack, answer.value + slack);
}

void PrintTo(const Case& c, std::ostream* out) {
  *out << fmt::format("{} {} {}, {} spp", c.scene->file.stem().string(), c.mode, c.sampler, c.spp);
}

std::string case_name(const testing::TestParamInfo<Case>& info) {
  return fmt::format("{}_{}_{}", info.param.scene->file.stem().string(), info.param.mode, info.param.sampler);
}

class StatisticalClosedForms : public testing::TestWithParam<Case> {};
class SlowClosedFormsOfOtherModes : public testing::TestWithParam<Case> {};

// What is wrong with the measured answers; that each is measured well enough is expected.
Objections find_wrong_answers(const Case& c, const Film& film) {
  Objections wrong;
  for (const SceneAnswer& answer : c.scene->answers) {
    const RunningStats stats = measure(film, answer);
    const TestResult test = t_test(stats, nearest_answer(answer, stats.mean()));
    const double se = std::sqrt(stats.variance_of_mean());
    if (test.p_value < kLevel)
      wrong.push_back(fmt::format("{}: measured {:.8g} +- {:.2g}, {:+.3f} %, t = {:.2f}", answer.what, stats.mean(), se,
                                  100 * (stats.mean() / answer.value - 1), test.statistic));
    EXPECT_TRUE(answer.value == 0 || would_be_seen(0.01, answer.value, se, kReplicates - 1, kLevel)) << fmt::format(
        "{}\n  standard error {:.3f} %: too few samples to see an error of 1 %", answer.what, 100 * se / answer.value);
  }
  return wrong;
}

std::string write_pictures(const Case& c, const Film& film) {
  const std::vector<float> ours = picture(film);
  std::vector<float> expected = ours;
  for (const SceneAnswer& a : c.scene->answers)
    if (a.quantity.component == Quantity::Component::kBeauty && !a.region)
      for (size_t i = 0; i < expected.size(); ++i)
        if (!a.quantity.channel || static_cast<size_t>(*a.quantity.channel) == i % 3)
          expected[i] = static_cast<float>(a.value);
  return write_evidence(c.scene->file.stem().string(), film.settings().width, film.settings().height, ours, expected);
}

void expect_the_answer(const Case& c) {
  ASSERT_EQ(c.scene->problem, "");
  expect_in_two_runs(testing::PrintToString(c), [&c](const TestRun& run) {
    const Film film = render_case(c, 1 + run.fresh_seeds, c.spp * run.more);
    Objections wrong = find_wrong_answers(c, film);
    if (!wrong.empty() && !run.is_first()) wrong.push_back(write_pictures(c, film));
    return wrong;
  });
}

TEST_P(StatisticalClosedForms, GiveTheAnswer) { expect_the_answer(GetParam()); }
TEST_P(SlowClosedFormsOfOtherModes, GiveTheAnswer) { expect_the_answer(GetParam()); }

// The false alarms of the test above, counted: p-values of right answers are uniform, whatever scene, mode and sampler.
// One answer of each case, because those of one film depend on each other. Measured once over 26805 tests: chi-square
// 9.2 with 19 degrees of freedom, 33 p-values below 0.001.
TEST(SlowClosedForms, PValuesOfRightAnswersAreUniform) {
  constexpr size_t kBins = 20;
  constexpr uint64_t kSeeds = 100;
  std::vector<double> observed(kBins), tail(2);
  uint64_t seed = 1000;
  for (const Case& c : all_cases()) {
    const SceneAnswer& answer = c.scene->answers.front();
    for (uint64_t i = 0; i < kSeeds; ++i) {
      const RunningStats stats = measure(render_case(c, ++seed, std::max(c.spp / 12, kReplicates)), answer);
      if (stats.variance_of_mean() <= sqr(answer.value * kRounding)) break;  // nothing random about this case
      const double p = t_test(stats, answer.value).p_value;
      ++observed[std::min(static_cast<size_t>(p * kBins), kBins - 1)];
      ++tail[p < 0.001];
    }
  }
  const double tests = tail[0] + tail[1];
  ASSERT_GT(tests, 3000);
  const TestResult uniform = chi_square_test(observed, std::vector<double>(kBins, tests / kBins), 5);
  EXPECT_GT(uniform.p_value, kFamilyLevel) << "chi-square " << uniform.statistic;
  const TestResult tails = chi_square_test(tail, std::vector<double>{0.999 * tests, 0.001 * tests}, 1);
  EXPECT_GT(tails.p_value, kFamilyLevel) << tail[1] << " p-values below 0.001 among " << tests;
  std::cout << fmt::format(
      "{} tests: chi-square of the p-values {:.1f} with {} degrees of freedom, p = {:.3f}; {} below 0.001\n", tests,
      uniform.statistic, uniform.dof, uniform.p_value, tail[1]);
}

INSTANTIATE_TEST_SUITE_P(All, StatisticalClosedForms, testing::ValuesIn(cases(true)), case_name);
INSTANTIATE_TEST_SUITE_P(All, SlowClosedFormsOfOtherModes, testing::ValuesIn(cases(false)), case_name);

}  // namespace
}  // namespace etd
