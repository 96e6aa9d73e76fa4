// Schedules: who decides how many samples each pixel gets.
#include "render/schedule.h"

#include <gtest/gtest.h>

#include "noise_integrator.h"
#include "render/driver.h"
#include "verify/statistics/estimate.h"

namespace etd {
namespace {

// Pixels get one, two or three samples of each replicate in each pass, by their column.
class ByColumn : public Schedule {
 public:
  ByColumn(const PixelBounds& crop, uint32_t passes) : passes_(passes) {
    ranges_.crop = crop;
    ranges_.ranges.resize(static_cast<size_t>(crop.width()) * static_cast<size_t>(crop.height()));
  }
  static uint32_t per_pass(int x) { return 1 + static_cast<uint32_t>(x) % 3; }
  std::optional<Pass> next(const SoFar& so_far) override {
    errors.push_back(so_far.error);
    if (done_ == passes_) return {};
    size_t i = 0;
    for (int y = ranges_.crop.y0; y < ranges_.crop.y1; ++y)
      for (int x = ranges_.crop.x0; x < ranges_.crop.x1; ++x, ++i)
        ranges_.ranges[i] = {done_ * per_pass(x), (done_ + 1) * per_pass(x)};
    const Pass pass{.index = done_, .begin = 3 * done_, .end = 3 * (done_ + 1), .ranges = &ranges_};
    ++done_;
    return pass;
  }
  double expected(const SoFar&) const override { return 3.0 * passes_; }
  std::vector<double> errors;

 private:
  SampleRanges ranges_;
  uint32_t passes_, done_ = 0;
};

TEST(Schedule, PixelsMayGetUnequalNumbersOfSamples) {
  FilmSettings settings{.width = 30, .height = 12, .crop = {2, 1, 29, 11}, .replicates = 4};
  Film films[] = {Film(settings), Film(settings)};
  for (int i = 0; i < 2; ++i) {
    ByColumn schedule(settings.crop, 20);
    NoiseIntegrator integrator(settings, 5 + i);
    RenderObserver nobody;
    const RenderResult result = render(integrator, films[i], {.spp = 240, .threads = 1 + i}, schedule, nobody);
    EXPECT_EQ(result.spp, 80u);  // that every pixel has
    EXPECT_TRUE(result.unequal);
    EXPECT_EQ(result.stopped_by, StoppedBy::kSamples);
    EXPECT_EQ(schedule.errors.size(), 21u);
    EXPECT_EQ(schedule.errors.front(), HUGE_VAL);
    EXPECT_LT(schedule.errors.back(), schedule.errors[2]);
  }
  // Each pixel is an estimate of its own mean, whose error is that of its own number of samples.
  double z2 = 0, pixels = 0;
  for (int y = 1; y < 11; ++y)
    for (int x = 2; x < 29; ++x) {
      const PixelSums sums = films[0].total(x, y);
      ASSERT_EQ(sums.direct, films[1].total(x, y).direct);
      ASSERT_EQ(sums.count, 4.0 * 20 * ByColumn::per_pass(x));
      const double mean = x + 1, error = mean / std::sqrt(3.0 * sums.count);
      EXPECT_NEAR(sums.mean_radiance()[1], mean, 5 * error);
      z2 += sqr((sums.mean_radiance()[1] - mean) / error), ++pixels;
    }
  // A mean of 270 squares of normal numbers; beyond these bounds in one of 10^6 cases.
  EXPECT_NEAR(z2 / pixels, 1.0, 5 * std::sqrt(2.0 / pixels));
  const Estimate estimate = make_estimate(films[0]);
  EXPECT_EQ(estimate.samples, 80.0);
}

TEST(Schedule, UntilErrorCountsItsTests) {
  const FilmSettings settings{.width = 4, .height = 4, .crop = {0, 0, 4, 4}, .replicates = 4};
  const Film film(settings);
  UniformSchedule uniform(1000);
  UntilError schedule(uniform, 0.1, 4);
  double error = HUGE_VAL;
  uint32_t end = 0;
  while (const auto pass = schedule.next({film, error})) {
    EXPECT_EQ(pass->begin, end);
    end = pass->end;
    error = 1.0 / std::sqrt(4.0 * end);  // 0.1 after 25 samples of each replicate
  }
  EXPECT_EQ(end, 32u);
  EXPECT_EQ(schedule.error_tests(), 3u);  // after 8, 16 and 32
  EXPECT_EQ(schedule.reason(), StoppedBy::kError);
  EXPECT_EQ(schedule.expected({film, 0.2}), 128.0);
}

}  // namespace
}  // namespace etd
