// Runs subjects of the battery on all threads and says what came out: a row for each model, pictures, JSON.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>

#include "verify/battery/battery.h"

namespace etd {

// All settings of one model together.
struct ModelReport {
  std::string family, model;
  size_t settings = 0;
  std::vector<CheckResult> results;
  double seconds = 0;  // of all its settings, one after another
  bool passed() const;
};

struct BatteryRun {
  std::vector<ModelReport> models;  // in the order of the subjects
  bool complete = true;             // false: stopped before all had run
  bool passed() const;
};

// Told by any thread, one at a time, after each subject.
using BatteryProgress = std::function<void(size_t done, size_t all, const std::string& name)>;

// `options.family_level` is that of all subjects together. `threads`: 0 for all cores. When `stop` becomes true, what
// has not begun is left out.
BatteryRun run_battery(const std::vector<BatterySubject>& subjects, BatteryOptions options, int threads,
                       const BatteryProgress& progress, const std::atomic<bool>& stop);

// A row for each model; below it every check when `details`, otherwise those that failed, with their evidence.
std::string battery_table(const BatteryRun& run, bool details);
std::string battery_json(const BatteryRun& run);

// Writes what was sampled, what was expected and the difference in standard deviations (red: more, blue: fewer, full at
// 5), one above the other, as PNG. Returns what went wrong, or an empty string.
std::string write_check_map(const std::filesystem::path& path, const CheckMap& map);
// Writes the maps of all checks that have them, or of those that failed. Returns the files; `problem` is what went
// wrong.
std::vector<std::filesystem::path> write_check_pictures(const BatteryRun& run, const std::filesystem::path& folder,
                                                        bool all, std::string& problem);

}  // namespace etd
