#include "render/driver.h"

#include <cassert>
#include <chrono>
#include <mutex>
#include <new>
#include <optional>

#include "render/items.h"

namespace etd {
namespace {

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

// How many samples pixels have.
void count_samples(const Film& film, RenderResult& result) {
  const PixelBounds& crop = film.settings().crop;
  double empty = 0, all = 0, fewest = HUGE_VAL, most = 0;
  for (int y = crop.y0; y < crop.y1; ++y)
    for (int x = crop.x0; x < crop.x1; ++x, ++all) {
      const double count = film.light(x, y).count;
      fewest = std::min(fewest, count);
      most = std::max(most, count);
      empty += count == 0 ? 1 : 0;
    }
  if (all == 0) return;
  result.spp = static_cast<uint32_t>(fewest);
  result.empty = empty / all;
  result.unequal = result.unequal || fewest != most;
}

class RenderLoop {
 public:
  RenderLoop(Integrator& integrator, Film& film, const DriverSettings& settings, Schedule& schedule,
             RenderObserver& observer, const std::atomic<bool>* stop)
      : integrator_(integrator),
        traits_(integrator.traits()),
        film_(film),
        settings_(settings),
        replicates_(film.settings().replicates),
        first_replicate_(film.settings().first_replicate),
        schedule_(schedule),
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
  bool render_pass(Pass pass);
  bool render_replicates(const Pass& pass);
  bool render_phase(const Pass& pass, uint32_t phase, double share_before, double share_after);
  void fold_splats(const Pass& pass, const ItemCounts& before);
  void show_film() {
    if (observer_.wants_film()) observer_.on_film(film_);
  }
  bool worth_starting(const Pass& pass) const;
  Schedule::SoFar so_far() const { return {film_, result_.error}; }
  RenderProgress progress(const Pass& pass, double share_of_pass) const;

  Integrator& integrator_;
  const IntegratorTraits traits_;
  Film& film_;
  const DriverSettings& settings_;
  const uint32_t replicates_, first_replicate_;
  Schedule& schedule_;
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
  count_samples(film_, result_);
  result_.error_tests = schedule_.error_tests();
  const ItemCounts counts = counts_.sum();
  result_.rays = counts.rays;
  result_.invalid = counts.invalid;
  result_.seconds = seconds();
  return result_;
}

void RenderLoop::run_passes() {
  std::optional<Pass> pass = schedule_.next(so_far());
  if (!pass) result_.stopped_by = schedule_.reason();
  while (pass) {
    const double begun = seconds();
    const bool complete = render_pass(*pass);
    if (pass->index == 0) result_.first_pass_seconds = seconds();
    result_.error = estimated_error(film_, workers_);
    if (!complete) {
      result_.unequal = any_items_;
      result_.stopped_by = stop_requested() ? StoppedBy::kInterrupt : StoppedBy::kTime;
      return;
    }
    seconds_per_sample_ = (seconds() - begun) / (pass->end - pass->begin);
    const std::optional<Pass> following = schedule_.next(so_far());
    std::optional<StoppedBy> reason;
    if (!following)
      reason = schedule_.reason();
    else if (stop_requested())
      reason = StoppedBy::kInterrupt;
    else if (!worth_starting(*following))
      reason = StoppedBy::kTime;
    RenderProgress now = progress(*pass, 1);
    if (reason) now.share = 1;
    observer_.on_pass_end(now);
    if (reason) {
      result_.stopped_by = *reason;
      return;
    }
    show_film();
    pass = following;
  }
}

// False when items were left out, here and below.
bool RenderLoop::render_pass(Pass pass) {
  any_items_ = false;
  pass.first_replicate = first_replicate_, pass.end_replicate = first_replicate_ + replicates_;
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
  const double before = static_cast<double>(pass.first_replicate - first_replicate_) / replicates_;
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
    film_.fold_splats(crop.y0 + static_cast<int>(row), pass.first_replicate - first_replicate_,
                      now.light_paths - before.light_paths, now.rays.total() - before.rays.total());
  });
}

// Passes that end in time leave an image of equal sample counts, the same as without a time limit. Only when much time
// would be wasted otherwise is one begun that will be cut off.
bool RenderLoop::worth_starting(const Pass& pass) const {
  const double left = settings_.seconds - seconds();
  if (left <= 0) return false;
  const double needed = seconds_per_sample_ * (pass.end - pass.begin);
  return kPredictionMargin * needed <= left || left >= kWorthCuttingShort * settings_.seconds;
}

RenderProgress RenderLoop::progress(const Pass& pass, double share_of_pass) const {
  RenderProgress now{
      .spp = settings_.spp, .rays = counts_.sum().rays.total(), .seconds = seconds(), .error = result_.error};
  now.spp_done = (pass.begin + (pass.end - pass.begin) * share_of_pass) * replicates_;
  const double expected = std::min<double>(settings_.spp, schedule_.expected(so_far()) * replicates_);
  now.share = std::max(now.spp_done / expected, now.seconds / settings_.seconds);
  constexpr double kAlmostAll = 0.999;
  now.share = std::min(now.share, kAlmostAll);
  return now;
}

}  // namespace

RenderResult render(Integrator& integrator, Film& film, const DriverSettings& settings, Schedule& schedule,
                    RenderObserver& observer, const std::atomic<bool>* stop) {
  return RenderLoop(integrator, film, settings, schedule, observer, stop).run();
}

RenderResult render(Integrator& integrator, Film& film, const DriverSettings& settings, RenderObserver& observer,
                    const std::atomic<bool>* stop) {
  const uint32_t replicates = film.settings().replicates;
  assert(settings.spp % replicates == 0);
  UniformSchedule uniform(settings.spp / replicates);
  UntilError until_error(uniform, settings.error, replicates);
  Schedule& schedule = settings.error > 0 ? static_cast<Schedule&>(until_error) : uniform;
  return render(integrator, film, settings, schedule, observer, stop);
}

}  // namespace etd
