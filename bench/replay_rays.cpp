// The share of a render's time that is spent inside Embree. Renders a scene on one thread, records the very rays of
// that render, and sends them through the acceleration structure alone; all in processor time of this process, so that
// other programs on the machine hardly matter. docs/performance.md says what the share leaves out.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/flush_to_zero.h"
#include "recorded_paths.h"

namespace etd {
namespace {

constexpr const char* kUsage =
    "etendue_replay_rays SCENE WIDTH HEIGHT SPP\n"
    "\n"
    "Renders SCENE on one thread, replays its rays through Embree alone, and prints both times as JSON.\n";
constexpr int kRepeats = 3;  // of which the fastest counts

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// The processor seconds of the fastest of some calls.
template <class F>
double fastest(F&& f) {
  double best = HUGE_VAL;
  for (int i = 0; i < kRepeats; ++i) {
    const double begun = processor_seconds();
    f();
    best = std::min(best, processor_seconds() - begun);
  }
  return best;
}

struct RecordedRay {
  RayKind kind;
  Ray ray;
};

// Returns how many rays met something, so that no compiler leaves the queries out.
size_t trace(const Accelerator& accelerator, const std::vector<RecordedRay>& rays) {
  const FlushToZero mode;
  size_t met = 0;
  Hit hit;
  for (const RecordedRay& r : rays)
    met += r.kind == RayKind::kShadow ? accelerator.occluded(r.ray) : accelerator.intersect(r.ray, hit);
  return met;
}

uint32_t to_number(const char* text) {
  size_t end = 0;
  unsigned long value = 0;
  try {
    value = std::stoul(text, &end);
  } catch (const std::exception&) {
  }
  if (end == 0 || text[end] != '\0' || value == 0 || value > 65536)
    throw std::invalid_argument(fmt::format("\"{}\" is no number from 1 to 65536", text));
  return static_cast<uint32_t>(value);
}

void measure(const char* scene, uint32_t width, uint32_t height, uint32_t spp) {
  RenderOverrides overrides;
  overrides.size = {static_cast<int>(width), static_cast<int>(height)};
  overrides.spp = spp, overrides.replicates = 1, overrides.threads = 1;
  PreparedRender prepared = load_for_bench(scene, overrides);

  std::vector<RecordedRay> rays;
  std::array<uint64_t, 3> counts{};
  for_each_path(prepared, [&](const PathRecord& path) {
    for_each_ray(prepared, path, [&](RayKind kind, const Ray& ray) {
      rays.push_back({kind, ray});
      ++counts[static_cast<size_t>(kind)];
    });
  });

  RayCounts rendered;
  RenderObserver nobody;
  const double render = fastest([&] { rendered = run_render(prepared, nobody).result.rays; });
  if (rendered.camera != counts[0] || rendered.indirect != counts[1] || rendered.shadow != counts[2])
    throw std::runtime_error(fmt::format("the recorded rays ({}, {}, {}) are not those of the render ({}, {}, {})",
                                         counts[0], counts[1], counts[2], rendered.camera, rendered.indirect,
                                         rendered.shadow));

  const Accelerator& accelerator = *prepared.compiled.scene->accelerator;
  size_t met = 0;
  const double replay = fastest([&] { met = trace(accelerator, rays); });
  std::array<double, 3> ns{};
  for (size_t kind = 0; kind < ns.size(); ++kind) {
    std::vector<RecordedRay> some;
    for (const RecordedRay& r : rays)
      if (static_cast<size_t>(r.kind) == kind) some.push_back(r);
    const double seconds = fastest([&] { met = std::max(met, trace(accelerator, some)); });
    ns[kind] = some.empty() ? 0 : 1e9 * seconds / static_cast<double>(some.size());
  }
  fmt::print(
      "{{\"rays\": {{\"camera\": {}, \"indirect\": {}, \"shadow\": {}}}, \"met\": {}, \"ns_per_ray\": {{\"camera\": "
      "{:.1f}, \"indirect\": {:.1f}, \"shadow\": {:.1f}}}, \"render_seconds\": {:.4f}, \"replay_seconds\": {:.4f}, "
      "\"share\": {:.4f}}}\n",
      counts[0], counts[1], counts[2], met, ns[0], ns[1], ns[2], render, replay, replay / render);
}

int run(int argc, char** argv) {
  if (argc == 2 && std::string(argv[1]) == "--help") return fmt::print("{}", kUsage), 0;
  if (argc != 5) return fmt::print(stderr, "{}", kUsage), 2;
  try {
    measure(argv[1], to_number(argv[2]), to_number(argv[3]), to_number(argv[4]));
  } catch (const std::exception& e) {
    fmt::print(stderr, "etendue_replay_rays: {}\n", e.what());
    return 2;
  }
  return 0;
}

}  // namespace
}  // namespace etd

int main(int argc, char** argv) { return etd::run(argc, argv); }
