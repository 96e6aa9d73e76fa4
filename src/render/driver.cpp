#include "render/driver.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cassert>
#include <chrono>

#include "core/flush_to_zero.h"
#include "render/threads.h"

namespace etd {
namespace {

constexpr uint32_t kLongestPass = 16;  // samples per replicate: keeps items short enough to stop soon

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Integers, so that the order in which threads add them does not matter.
struct SharedCounts {
  std::atomic<uint64_t> camera{0}, indirect{0}, shadow{0}, items{0};
  void add(const RayCounts& rays) {
    camera += rays.camera, indirect += rays.indirect, shadow += rays.shadow;
    ++items;
  }
  RayCounts rays() const { return {camera, indirect, shadow}; }
};

// Calls f(i) for i in [0, n), each on whichever thread is free next.
template <class F>
void for_each_item(ThreadLimit& threads, size_t n, F f) {
  threads.run([n, &f] {
    tbb::parallel_for(
        tbb::blocked_range<size_t>(0, n, 1),
        [&f](const tbb::blocked_range<size_t>& range) {
          const FlushToZero flush;
          for (size_t i = range.begin(); i < range.end(); ++i) f(i);
        },
        tbb::simple_partitioner());
  });
}

struct RowSums {
  double luminance = 0, error = 0;
};

double estimated_error(const Film& film, ThreadLimit& threads) {
  const PixelBounds& crop = film.settings().crop;
  if (crop.empty()) return 0;
  const double pixels = static_cast<double>(crop.width()) * crop.height();
  // Sums by row, added in the order of rows: the same for any number of threads.
  std::vector<RowSums> rows(static_cast<size_t>(crop.height()));
  for_each_item(threads, rows.size(), [&](size_t row) {
    const int y = crop.y0 + static_cast<int>(row);
    for (int x = crop.x0; x < crop.x1; ++x) rows[row].luminance += film.total(x, y).mean_radiance()[3];
  });
  double mean = 0;
  for (const RowSums& row : rows) mean += row.luminance / pixels;
  const double floor = 0.01 * sqr(mean);
  for_each_item(threads, rows.size(), [&](size_t row) {
    const int y = crop.y0 + static_cast<int>(row);
    for (int x = crop.x0; x < crop.x1; ++x) {
      const double variance = sqr(film.standard_error(x, y)[3]);
      if (variance != 0) rows[row].error += variance / (sqr(film.total(x, y).mean_radiance()[3]) + floor);
    }
  });
  double sum = 0;
  for (const RowSums& row : rows) sum += row.error;
  return std::sqrt(sum / pixels);
}

}  // namespace

std::vector<Pass> pass_schedule(uint32_t samples_per_replicate) {
  std::vector<Pass> passes;
  for (uint32_t begin = 0; begin < samples_per_replicate;) {
    const uint32_t length = std::clamp(begin, 1u, kLongestPass);
    const uint32_t end = begin + std::min(length, samples_per_replicate - begin);
    passes.push_back({static_cast<uint32_t>(passes.size()), begin, end});
    begin = end;
  }
  return passes;
}

double estimated_error(const Film& film, int threads) {
  ThreadLimit limit(threads);
  return estimated_error(film, limit);
}

RenderResult render(Integrator& integrator, Film& film, const DriverSettings& settings, RenderObserver& observer,
                    const std::atomic<bool>* stop) {
  const uint32_t replicates = film.settings().replicates;
  assert(settings.spp % replicates == 0);
  ThreadLimit threads(settings.threads);
  const Clock::time_point start = Clock::now();
  const auto stopped = [stop] { return stop && stop->load(std::memory_order_relaxed); };

  RenderResult result;
  SharedCounts counts;
  for (const Pass& pass : pass_schedule(settings.spp / replicates)) {
    if ((result.interrupted = stopped())) break;
    integrator.prepare(pass);
    const size_t items = integrator.work_items(pass);
    counts.items = 0;
    const auto progress = [&](double share_of_pass) {
      const double done = pass.begin + (pass.end - pass.begin) * share_of_pass;
      return RenderProgress{settings.spp, done * replicates, counts.rays().total(), seconds_since(start), result.error};
    };
    for_each_item(threads, items, [&](size_t item) {
      if (stopped()) return;
      RayCounts rays;
      integrator.render(pass, item, film, rays);
      counts.add(rays);
      observer.on_progress(progress(static_cast<double>(counts.items) / static_cast<double>(items)));
    });
    integrator.end(pass);
    result.error = estimated_error(film, threads);
    if ((result.interrupted = counts.items < items)) break;
    result.spp = pass.end * replicates;
    observer.on_pass_end(progress(1));
  }
  result.rays = counts.rays();
  result.seconds = seconds_since(start);
  return result;
}

}  // namespace etd
