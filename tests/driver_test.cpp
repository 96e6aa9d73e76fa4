#include "render/driver.h"

#include <gtest/gtest.h>
#include <xmmintrin.h>

#include <array>
#include <stdexcept>
#include <thread>

#include "noise_integrator.h"
#include "render_recorder.h"
#include "same_bits.h"

namespace etd {
namespace {

const FilmSettings kFilm{.width = 40, .height = 30, .crop = {0, 0, 40, 30}, .replicates = 2};

Film render_noise(const FilmSettings& settings, int threads, int tile, uint32_t spp = 12) {
  Film film(settings);
  NoiseIntegrator integrator(settings, tile);
  RenderObserver nobody;
  render(integrator, film, {spp, threads}, nobody);
  return film;
}

std::vector<Pass> schedule(uint32_t n) {
  std::vector<Pass> passes;
  for (Pass pass = first_pass(n); pass.begin < n; pass = next_pass(pass, n)) passes.push_back(pass);
  return passes;
}

TEST(PassSchedule, CoversEverySampleOnceInPassesThatDependOnTheIndexAlone) {
  const std::vector<Pass> longest = schedule(100);
  EXPECT_EQ(longest[0].end, 1u);
  EXPECT_EQ(longest[1].end, 2u);
  EXPECT_EQ(longest[2].end, 4u);
  EXPECT_EQ(longest[3].end, 8u);
  EXPECT_EQ(longest[4].end, 16u);
  EXPECT_EQ(longest[5].end, 32u);
  EXPECT_EQ(longest[6].end, 48u);
  for (uint32_t n = 0; n <= 100; ++n) {
    uint32_t next = 0;
    for (const Pass& pass : schedule(n)) {
      EXPECT_EQ(pass.begin, next);
      EXPECT_EQ(pass.begin, longest[pass.index].begin);
      EXPECT_EQ(pass.end, std::min(n, longest[pass.index].end));
      next = pass.end;
    }
    EXPECT_EQ(next, n);
  }
}

TEST(Driver, BitsDoNotDependOnThreadsTilesOrCrop) {
  const Film reference = render_noise(kFilm, 1, 16);
  expect_same_bits(reference, render_noise(kFilm, 2, 16));
  expect_same_bits(reference, render_noise(kFilm, 5, 16));
  expect_same_bits(reference, render_noise(kFilm, 2, 7));
  FilmSettings part = kFilm;
  part.crop = {5, 3, 21, 29};
  expect_same_bits(reference, render_noise(part, 2, 4));
}

TEST(Driver, CountsAndEstimatesTheError) {
  for (uint32_t replicates : {1u, 2u, 8u}) {
    FilmSettings settings = kFilm;
    settings.replicates = replicates;
    Film film(settings);
    NoiseIntegrator integrator(settings);
    RenderObserver nobody;
    const RenderResult result = render(integrator, film, {64, 0}, nobody);
    EXPECT_EQ(result.spp, 64u);
    EXPECT_EQ(result.stopped_by, StoppedBy::kSamples);
    EXPECT_FALSE(result.unequal);
    EXPECT_EQ(result.rays.camera, 40u * 30u * 64u);
    EXPECT_EQ(result.rays.indirect, 2u * result.rays.camera);
    EXPECT_EQ(result.rays.shadow, 3u * result.rays.camera);
    EXPECT_EQ(film.total(3, 4).count, 64.0);
    // Relative variance of a pixel v = 1/(3 * 64), in the measure's mean over pixels of means m = 1 ... 40.
    double expected = 0, mean = 20.5;
    for (int m = 1; m <= 40; ++m) expected += m * m / (3.0 * 64.0) / (m * m + 0.01 * mean * mean) / 40;
    EXPECT_NEAR(result.error, std::sqrt(expected), 0.04 * std::sqrt(expected)) << replicates;
    EXPECT_EQ(estimated_error(film, 2), result.error);
  }
}

TEST(Driver, ErrorIsInfiniteAfterOneSampleAndZeroForABlackImage) {
  FilmSettings settings = kFilm;
  settings.replicates = 1;
  EXPECT_EQ(estimated_error(render_noise(settings, 1, 16, 1)), HUGE_VAL);
  Film black(settings);
  PixelSums sums;
  sums.add({}), sums.add({});
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x) black.add(x, y, 0, sums);
  EXPECT_EQ(estimated_error(black), 0.0);
}

TEST(Driver, ReportsProgressInsideAndAfterPasses) {
  std::atomic<bool> stop{false};
  RenderRecorder recorder(stop, 1e9);
  Film film(kFilm);
  NoiseIntegrator integrator(kFilm);
  render(integrator, film, {12, 2}, recorder, &stop);
  EXPECT_EQ(recorder.highest, 12.0);
  EXPECT_EQ(recorder.pass_ends, (std::vector<double>{2, 4, 8, 12}));
}

TEST(Driver, StoppingFinishesRunningItemsAndLeavesAValidEstimate) {
  std::atomic<bool> stop{false};
  RenderRecorder recorder(stop, 5.0);
  Film film(kFilm);
  NoiseIntegrator integrator(kFilm, 4);
  const RenderResult result = render(integrator, film, {1000, 2}, recorder, &stop);
  EXPECT_EQ(result.stopped_by, StoppedBy::kInterrupt);
  EXPECT_EQ(result.spp, 4u);
  EXPECT_TRUE(std::isfinite(result.error));
  uint64_t samples = 0;
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x) {
      const double count = film.total(x, y).count;
      EXPECT_TRUE(count == 4.0 || count == 8.0) << count;
      EXPECT_EQ(film.sums(x, y, 0).count, film.sums(x, y, 1).count);
      samples += static_cast<uint64_t>(count);
    }
  EXPECT_EQ(samples, result.rays.camera);
  EXPECT_LT(samples, 40u * 30u * 8u);
}

TEST(Driver, StoppedBeforeTheFirstItemGivesABlackImageOfInfiniteError) {
  std::atomic<bool> stop{true};
  RenderObserver nobody;
  Film film(kFilm);
  NoiseIntegrator integrator(kFilm);
  const RenderResult result = render(integrator, film, {4, 2}, nobody, &stop);
  EXPECT_EQ(result.stopped_by, StoppedBy::kInterrupt);
  EXPECT_EQ(result.rays.total(), 0u);
  EXPECT_EQ(result.error, HUGE_VAL);
  EXPECT_EQ(result.empty, 1.0);
}

TEST(StoppingByError, IsTestedAtPowersOfTwoThatEndPasses) {
  for (uint32_t replicates : {1u, 2u, 3u, 4u, 6u, 8u, 32u, 48u, 64u, 4096u}) {
    std::vector<uint32_t> tested;  // samples per pixel
    for (const Pass& pass : schedule(3000))
      if (tests_error(pass.end, replicates)) tested.push_back(pass.end * replicates);
    const bool power_of_two = (replicates & (replicates - 1)) == 0;
    ASSERT_GE(tested.size(), 5u);
    if (power_of_two) {
      EXPECT_EQ(tested.front(), std::max(32u, replicates));
    }
    EXPECT_GE(tested.front(), 32u);
    EXPECT_LT(tested.front(), std::max(64u, 2 * replicates));
    // Every doubling up to 2048 samples per replicate, so that none falls between two passes.
    for (size_t i = 1; i < tested.size(); ++i) EXPECT_EQ(tested[i], 2 * tested[i - 1]);
    EXPECT_EQ(tested.back(), 2048u * replicates);
  }
}

// What `render` makes of the noise with these settings.
RenderResult stop_noise(const DriverSettings& settings, Film& film) {
  NoiseIntegrator integrator(film.settings());
  RenderObserver nobody;
  return render(integrator, film, settings, nobody);
}

// The error of the noise after `spp` samples: see CountsAndEstimatesTheError.
double noise_error(double spp) {
  double sum = 0;
  for (int m = 1; m <= 40; ++m) sum += m * m / (3.0 * spp) / (m * m + 0.01 * 20.5 * 20.5) / 40;
  return std::sqrt(sum);
}

TEST(StoppingByError, EndsAtTheFirstTestThatFindsItSmallEnough) {
  Film film(kFilm);
  const RenderResult result = stop_noise({.spp = kMaxSpp, .error = noise_error(90)}, film);
  EXPECT_EQ(result.stopped_by, StoppedBy::kError);
  EXPECT_EQ(result.spp, 128u);
  EXPECT_EQ(result.error_tests, 3u);
  EXPECT_FALSE(result.unequal);
  expect_same_bits(film, render_noise(kFilm, 1, 16, 128));
}

TEST(StoppingByError, SamplesAreAnUpperLimit) {
  Film film(kFilm);
  const RenderResult result = stop_noise({.spp = 48, .error = 1e-9}, film);
  EXPECT_EQ(result.stopped_by, StoppedBy::kSamples);
  EXPECT_EQ(result.spp, 48u);
  EXPECT_EQ(result.error_tests, 1u);
}

TEST(StoppingByTime, FinishesTheFirstPassInAnyCase) {
  Film film(kFilm);
  const RenderResult result = stop_noise({.spp = kMaxSpp, .seconds = 1e-9}, film);
  EXPECT_EQ(result.stopped_by, StoppedBy::kTime);
  EXPECT_EQ(result.spp, 2u);
  EXPECT_FALSE(result.unequal);
  expect_same_bits(film, render_noise(kFilm, 1, 16, 2));
}

TEST(StoppingByTime, WholePassesAreTheSameAsWithoutALimit) {
  FilmSettings small = kFilm;
  small.crop = {0, 0, 8, 8};  // one item: a pass that has begun is not cut off
  Film film(small);
  const RenderResult result = stop_noise({.spp = kMaxSpp, .seconds = 0.1}, film);
  EXPECT_EQ(result.stopped_by, StoppedBy::kTime);
  EXPECT_GE(result.spp, 2u);
  EXPECT_FALSE(result.unequal);
  expect_same_bits(film, render_noise(small, 2, 16, result.spp));
}

// Notes in which floating-point mode and on how many threads its items run.
class Probe : public Integrator {
 public:
  IntegratorTraits traits() const override { return {}; }
  size_t work_items(const Pass&, uint32_t) const override { return 64; }
  void render(const Pass&, uint32_t, size_t item, Sink&) override {
    if (item == fail_at) throw std::runtime_error("item failed");
    if ((_mm_getcsr() & 0x8040) != 0x8040) ++without_flush;
    const int now = ++running;
    for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) {
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    --running;
    ++calls;
  }
  size_t fail_at = 1000;
  std::atomic<int> without_flush{0}, running{0}, most{0}, calls{0};
};

TEST(Driver, ItemsFlushDenormalsAndUseTheThreadsAskedFor) {
  const unsigned mode = _mm_getcsr();
  for (int threads : {1, 2, 4}) {
    Probe probe;
    RenderObserver nobody;
    Film film(kFilm);
    render(probe, film, {2, threads}, nobody);
    EXPECT_EQ(probe.without_flush, 0);
    EXPECT_LE(probe.most, threads);
    if (threads == 1) {
      EXPECT_EQ(probe.most, 1);
    }
  }
  EXPECT_EQ(_mm_getcsr() & 0x8040, mode & 0x8040);
}

// Its second pass takes much longer than the first one makes believe.
class SlowSecondPass : public NoiseIntegrator {
 public:
  using NoiseIntegrator::NoiseIntegrator;
  void render(const Pass& pass, uint32_t phase, size_t item, Sink& sink) override {
    if (pass.index > 0) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    NoiseIntegrator::render(pass, phase, item, sink);
  }
};

TEST(StoppingByTime, CutsAPassThatTakesTooLong) {
  Film film(kFilm);
  SlowSecondPass integrator(kFilm, 4);  // 80 items
  RenderObserver nobody;
  const RenderResult result = render(integrator, film, {.spp = kMaxSpp, .threads = 2, .seconds = 1}, nobody);
  EXPECT_EQ(result.stopped_by, StoppedBy::kTime);
  EXPECT_EQ(result.spp, 2u);
  EXPECT_TRUE(result.unequal);
  EXPECT_EQ(film.total(0, 0).count, 4);
  EXPECT_EQ(film.total(39, 29).count, 2);
}

// Wants the film all the time, and notes whether items ran while it looked.
class Onlooker : public RenderObserver {
 public:
  explicit Onlooker(const Probe& probe) : probe_(probe) {}
  bool wants_film() const override { return true; }
  void on_film(const Film&) override {
    ++looks;
    if (probe_.running != 0) ++disturbed;
  }
  int looks = 0, disturbed = 0;

 private:
  const Probe& probe_;
};

TEST(Driver, TheFilmIsShownInTheMidstOfPassesWhileNothingRuns) {
  for (int threads : {1, 4}) {
    Probe probe;
    Onlooker onlooker(probe);
    Film film(kFilm);
    const RenderResult result = render(probe, film, {.spp = 4, .threads = threads}, onlooker);
    EXPECT_EQ(result.stopped_by, StoppedBy::kSamples);
    EXPECT_EQ(probe.calls, 2 * 64);
    EXPECT_EQ(onlooker.disturbed, 0);
    if (threads == 1) {
      EXPECT_EQ(onlooker.looks, 63 + 1 + 63);  // after each item, and after the pass that is not the last
    }
    EXPECT_GE(onlooker.looks, 2);
  }
}

TEST(Driver, WithoutMemoryWhatIsDoneStays) {
  class NoMemoryLater : public NoiseIntegrator {
   public:
    using NoiseIntegrator::NoiseIntegrator;
    void render(const Pass& pass, uint32_t phase, size_t item, Sink& sink) override {
      if (pass.index == 2 && item == 5) throw std::bad_alloc();
      NoiseIntegrator::render(pass, phase, item, sink);
    }
  };
  NoMemoryLater integrator(kFilm, 4);
  RenderObserver nobody;
  Film film(kFilm), before(kFilm);
  const RenderResult result = render(integrator, film, {.spp = 64, .threads = 1}, nobody);
  EXPECT_EQ(result.stopped_by, StoppedBy::kMemory);
  EXPECT_EQ(result.spp, 4u);
  EXPECT_TRUE(result.unequal);
  EXPECT_EQ(result.empty, 0.0);
  render(integrator, before, {.spp = 4, .threads = 1}, nobody);
  const PixelBounds& crop = film.settings().crop;
  const int x = crop.x1 - 1, y = crop.y1 - 1;  // in the last item, which the pass did not reach
  EXPECT_EQ(film.total(x, y).count, 4);
  EXPECT_EQ(film.total(x, y).direct, before.total(x, y).direct);
}

TEST(Driver, ExceptionsOfAnIntegratorPassThrough) {
  Probe probe;
  probe.fail_at = 40;
  RenderObserver nobody;
  Film film(kFilm);
  EXPECT_THROW(render(probe, film, {2, 2}, nobody), std::runtime_error);
}

}  // namespace
}  // namespace etd
