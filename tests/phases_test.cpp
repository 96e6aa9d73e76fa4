// Passes of several phases, by an integrator that counts what it does.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <thread>

#include "render_recorder.h"

namespace etd {
namespace {

// Three phases: each item of the second one needs what all items of the first one left, and counts what is missing.
class InPhases : public Integrator {
 public:
  explicit InPhases(bool splats = false, bool may_be_cut = true) {
    traits_.splats = splats;
    traits_.may_be_cut = may_be_cut;
  }
  IntegratorTraits traits() const override { return traits_; }
  uint32_t phases(const Pass&) const override { return 3; }
  void begin(const Pass& pass, uint32_t phase) override {
    if (phase == 0) done_ = 0;
    if (phase > 0 && done_ != kItems[phase - 1]) ++missing;
    done_ = 0;
    order.push_back({pass.index, pass.first_replicate, pass.end_replicate, phase});
  }
  size_t work_items(const Pass&, uint32_t phase) const override { return kItems[phase]; }
  void render(const Pass& pass, uint32_t phase, size_t item, Sink& sink) override {
    std::this_thread::sleep_for(std::chrono::microseconds(300));
    ++done_;
    if (phase != 2) return;
    const int x = static_cast<int>(item);
    if (traits_.splats) {
      // Each item lights the pixel of the next one, from as many paths as the image has pixels.
      Sink::Splat(sink, 1, Spectrum(1.0f), {}).add((x + 1) % 12, 0, 1.0f);
      sink.count_light_paths(pass.end - pass.begin);
      return;
    }
    Sink::Pixel pixel(sink, x, 0);
    PixelSample s;
    s.direct = Spectrum(static_cast<float>(x + 1));
    for (uint32_t r = pass.first_replicate; r < pass.end_replicate; ++r)
      for (uint32_t i = pass.begin; i < pass.end; ++i) pixel.add(r, i, PixelSample(s));
  }
  std::vector<std::array<uint32_t, 4>> order;
  int missing = 0;

 private:
  static constexpr std::array<size_t, 3> kItems{40, 7, 12};
  IntegratorTraits traits_;
  std::atomic<size_t> done_{0};
};

FilmSettings row_film(uint32_t replicates, bool splats = false) {
  return {.width = 12, .height = 1, .crop = {0, 0, 12, 1}, .replicates = replicates, .splats = splats};
}

TEST(Phases, FollowEachOther) {
  for (int threads : {1, 3}) {
    InPhases integrator;
    Film film(row_film(2));
    RenderObserver nobody;
    EXPECT_EQ(render(integrator, film, {.spp = 8, .threads = threads}, nobody).spp, 8u);
    EXPECT_EQ(integrator.missing, 0);
    EXPECT_EQ(integrator.order.size(), 9u);
    EXPECT_EQ(integrator.order[4], (std::array<uint32_t, 4>{1, 0, 2, 1}));
    EXPECT_EQ(film.total(3, 0).mean_radiance()[1], 4.0);
  }
}

TEST(Phases, ProgressRunsThroughThem) {
  class Steps : public RenderObserver {
   public:
    void on_progress(const RenderProgress& p) override {
      if (p.spp_done < last) ++backwards;
      last = p.spp_done;
    }
    double last = 0;
    int backwards = 0;
  } steps;
  InPhases integrator;
  Film film(row_film(2));
  render(integrator, film, {.spp = 8, .threads = 1}, steps);
  EXPECT_EQ(steps.backwards, 0);
  EXPECT_EQ(steps.last, 8);
}

TEST(Phases, SplatsAreFoldedReplicateByReplicate) {
  for (int threads : {1, 3}) {
    InPhases integrator(true);
    Film film(row_film(4, true));
    RenderObserver nobody;
    const RenderResult result = render(integrator, film, {.spp = 8, .threads = threads}, nobody);
    EXPECT_EQ(result.spp, 8u);
    EXPECT_EQ(integrator.order.size(), 2u * 4 * 3);
    EXPECT_EQ(integrator.order[3], (std::array<uint32_t, 4>{0, 1, 2, 0}));
    for (uint32_t r = 0; r < 4; ++r) {
      EXPECT_EQ(film.sums(5, 0, r).count, 2.0);
      EXPECT_NEAR(film.sums(5, 0, r).direct[0], 2.0 / 12, 1e-15);  // one splat a pass over 12 pixels
    }
  }
}

TEST(Phases, APassThatMayNotBeCutIsFinished) {
  for (const bool may_be_cut : {true, false}) {
    InPhases integrator(false, may_be_cut);
    Film film(row_film(2));
    std::atomic<bool> stop{false};
    RenderRecorder recorder(stop, 3);  // in the midst of the second pass
    const RenderResult result = render(integrator, film, {.spp = 64, .threads = 2}, recorder, &stop);
    EXPECT_EQ(result.stopped_by, StoppedBy::kInterrupt);
    EXPECT_EQ(result.unequal, may_be_cut);
    EXPECT_EQ(result.spp, may_be_cut ? 2u : 4u);
  }
}

}  // namespace
}  // namespace etd
