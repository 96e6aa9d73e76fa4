#include "render/driver.h"

#include <cassert>
#include <chrono>
#include <mutex>
#include <new>
#include <optional>

#include "render/items.h"

namespace etd {
namespace {

constexpr uint32_t kLongestPass = 16;       // samples per replicate: keeps items short enough to stop soon
constexpr double kPredictionMargin = 1.1;   // by which a pass may take longer than the last one did
constexpr double kWorthCuttingShort = 0.1;  // of the time limit: less is given back rather than spent on half a pass

using Clock = std::chrono::steady_clock;

// What all items have counted so far. Their sums do not depend on the order in which threads add them.
class SharedCounts {
 public:
  void add(const ItemCounts& counts) {
    const std::lock_guard lock(mutex_);
    sum_ += counts;
  }
  ItemCounts sum() const {
    const std::lock_guard lock(mutex_);
    return sum_;
  }

 private:
  mutable std::mutex mutex_;
  ItemCounts sum_;
};

double share_without_samples(const Film& film) {
  const PixelBounds& crop = film.settings().crop;
  double empty = 0, all = 0;
  for (int y = crop.y0; y < crop.y1; ++y)
    for (int x = crop.x0; x < crop.x1; ++x, ++all) empty += film.total(x, y).count == 0 ? 1 : 0;
  return all > 0 ? empty / all : 0;
}

class RenderLoop {
 public:
  RenderLoop(Integrator& integrator, Film& film, const DriverSettings& settings, RenderObserver& observer,
             const std::atomic<bool>* stop)
      : integrator_(integrator),
        traits_(integrator.traits()),
        film_(film),
        settings_(settings),
        replicates_(film.settings().replicates),
        samples_(settings.spp / replicates_),
        observer_(observer),
        stop_(stop),
        workers_(settings.threads) {}

  RenderResult run();

 private:
  void run_passes();
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  bool stop_requested() const { return stop_ && stop_->load(std::memory_order_relaxed); }
  bool over(const Pass& pass) const {
    return traits_.may_be_cut && (stop_requested() || (pass.index > 0 && seconds() >= settings_.seconds));
  }
  bool render_pass(const Pass& pass);
  bool render_replicates(const Pass& pass);
  bool render_phase(const Pass& pass, uint32_t phase, double share_before, double share_after);
  void fold_splats(const Pass& pass, const ItemCounts& before);
  void show_film() {
    if (observer_.wants_film()) observer_.on_film(film_);
  }
  std::optional<StoppedBy> reason_to_stop(const Pass& done);
  bool worth_starting(const Pass& pass) const;
  double expected_spp() const;
  RenderProgress progress(const Pass& pass, double share_of_pass) const;

  Integrator& integrator_;
  const IntegratorTraits traits_;
  Film& film_;
  const DriverSettings& settings_;
  const uint32_t replicates_, samples_;
  RenderObserver& observer_;
  const std::atomic<bool>* stop_;
  Workers workers_;
  const Clock::time_point start_ = Clock::now();
  SharedCounts counts_;
  bool any_items_ = false;         // of the running pass have been rendered
  double seconds_per_sample_ = 0;  // of a replicate, in the last complete pass
  RenderResult result_;
};

RenderResult RenderLoop::run() {
  if (stop_requested()) {
    result_.stopped_by = StoppedBy::kInterrupt;
  } else {
    try {
      run_passes();
    } catch (const std::bad_alloc&) {  // each pixel has whole samples all the same
      result_.unequal = true;
      result_.stopped_by = StoppedBy::kMemory;
    }
  }
  if (result_.spp == 0) result_.empty = share_without_samples(film_);
  const ItemCounts counts = counts_.sum();
  result_.rays = counts.rays;
  result_.invalid = counts.invalid;
  result_.seconds = seconds();
  return result_;
}

void RenderLoop::run_passes() {
  for (Pass pass = first_pass(samples_); pass.begin < samples_; pass = next_pass(pass, samples_)) {
    const double begun = seconds();
    pass.end_replicate = replicates_;
    const bool complete = render_pass(pass);
    result_.error = estimated_error(film_, workers_);
    if (!complete) {
      result_.unequal = any_items_;
      result_.stopped_by = stop_requested() ? StoppedBy::kInterrupt : StoppedBy::kTime;
      break;
    }
    result_.spp = pass.end * replicates_;
    seconds_per_sample_ = (seconds() - begun) / (pass.end - pass.begin);
    const std::optional<StoppedBy> reason = reason_to_stop(pass);
    RenderProgress now = progress(pass, 1);
    if (reason) now.share = 1;
    observer_.on_pass_end(now);
    if (reason) {
      result_.stopped_by = *reason;
      break;
    }
    show_film();
  }
}

// False when items were left out, here and below.
bool RenderLoop::render_pass(const Pass& pass) {
  any_items_ = false;
  if (!traits_.splats) return render_replicates(pass);
  // There is one buffer for splats, which belongs to one replicate at a time.
  for (Pass one = pass; one.first_replicate < pass.end_replicate; ++one.first_replicate) {
    one.end_replicate = one.first_replicate + 1;
    const ItemCounts before = counts_.sum();
    const bool complete = render_replicates(one);
    fold_splats(one, before);
    if (!complete) return false;
  }
  return true;
}

bool RenderLoop::render_replicates(const Pass& pass) {
  const uint32_t phases = integrator_.phases(pass);
  const double parts = static_cast<double>(phases) * replicates_;
  const double part = static_cast<double>(phases) * (pass.end_replicate - pass.first_replicate) / parts;
  const double before = static_cast<double>(pass.first_replicate) / replicates_;
  for (uint32_t phase = 0; phase < phases; ++phase) {
    const double from = before + part * phase / phases;
    if (!render_phase(pass, phase, from, from + part / phases)) return false;
  }
  return true;
}

// `from` and `to`: the shares of the pass that are done before and after.
bool RenderLoop::render_phase(const Pass& pass, uint32_t phase, double from, double to) {
  integrator_.begin(pass, phase);
  const size_t items = integrator_.work_items(pass, phase);
  std::atomic<size_t> next{0}, done{0};
  while (true) {
    run_items(workers_, next, items, [&](size_t item) {
      Sink sink(film_);
      integrator_.render(pass, phase, item, sink);
      counts_.add(sink.counts());
      const double share = static_cast<double>(++done) / static_cast<double>(items);
      observer_.on_progress(progress(pass, from + (to - from) * share));
      return !over(pass) && !observer_.wants_film();
    });
    any_items_ = any_items_ || done > 0;
    if (next >= items || over(pass)) break;
    show_film();
  }
  return done == items;
}

void RenderLoop::fold_splats(const Pass& pass, const ItemCounts& before) {
  const ItemCounts now = counts_.sum();
  const PixelBounds& crop = film_.settings().crop;
  for_each_item(workers_, static_cast<size_t>(crop.height()), [&](size_t row) {
    film_.fold_splats(crop.y0 + static_cast<int>(row), pass.first_replicate, now.light_paths - before.light_paths,
                      now.rays.total() - before.rays.total());
  });
}

std::optional<StoppedBy> RenderLoop::reason_to_stop(const Pass& done) {
  if (done.end == samples_) return StoppedBy::kSamples;
  if (stop_requested()) return StoppedBy::kInterrupt;
  if (settings_.error > 0 && tests_error(done.end, replicates_)) {
    ++result_.error_tests;
    if (result_.error <= settings_.error) return StoppedBy::kError;
  }
  if (!worth_starting(next_pass(done, samples_))) return StoppedBy::kTime;
  return {};
}

// Passes that end in time leave an image of equal sample counts, the same as without a time limit. Only when much time
// would be wasted otherwise is one begun that will be cut off.
bool RenderLoop::worth_starting(const Pass& pass) const {
  const double left = settings_.seconds - seconds();
  if (left <= 0) return false;
  const double needed = seconds_per_sample_ * (pass.end - pass.begin);
  return kPredictionMargin * needed <= left || left >= kWorthCuttingShort * settings_.seconds;
}

// The samples per pixel at which the error will be found small enough, if its square goes on falling like 1/n.
double RenderLoop::expected_spp() const {
  if (!(settings_.error > 0) || !std::isfinite(result_.error)) return HUGE_VAL;
  const double needed = std::max(result_.spp * sqr(result_.error / settings_.error), double{kFirstErrorTest});
  return replicates_ * std::exp2(std::ceil(std::log2(std::max(needed / replicates_, 1.0))));
}

RenderProgress RenderLoop::progress(const Pass& pass, double share_of_pass) const {
  RenderProgress now{
      .spp = settings_.spp, .rays = counts_.sum().rays.total(), .seconds = seconds(), .error = result_.error};
  now.spp_done = (pass.begin + (pass.end - pass.begin) * share_of_pass) * replicates_;
  now.share = std::max(now.spp_done / std::min<double>(settings_.spp, expected_spp()), now.seconds / settings_.seconds);
  constexpr double kAlmostAll = 0.999;
  now.share = std::min(now.share, kAlmostAll);
  return now;
}

Pass cut_pass(uint32_t index, uint32_t begin, uint32_t length, uint32_t samples) {
  return {.index = index, .begin = begin, .end = begin + std::min(length, samples - std::min(begin, samples))};
}

}  // namespace

Pass first_pass(uint32_t samples_per_replicate) { return cut_pass(0, 0, 1, samples_per_replicate); }

Pass next_pass(const Pass& last, uint32_t samples_per_replicate) {
  return cut_pass(last.index + 1, last.end, std::clamp(last.end, 1u, kLongestPass), samples_per_replicate);
}

bool tests_error(uint32_t samples_per_replicate, uint32_t replicates) {
  const bool power_of_two = (samples_per_replicate & (samples_per_replicate - 1)) == 0;
  return power_of_two && uint64_t{samples_per_replicate} * replicates >= kFirstErrorTest;
}

RenderResult render(Integrator& integrator, Film& film, const DriverSettings& settings, RenderObserver& observer,
                    const std::atomic<bool>* stop) {
  assert(settings.spp % film.settings().replicates == 0);
  return RenderLoop(integrator, film, settings, observer, stop).run();
}

}  // namespace etd
