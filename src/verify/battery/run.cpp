#include "verify/battery/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <nlohmann/json.hpp>

#include "render/workers.h"
#include "verify/statistics/statistics.h"

namespace etd {

namespace {

bool all_passed(const std::vector<CheckResult>& results) {
  return std::all_of(results.begin(), results.end(), [](const CheckResult& r) { return r.passed; });
}

// The smallest p-value of a model's checks, corrected for their number; nothing when none is statistical.
std::optional<double> smallest_p(const ModelReport& m) {
  double p = 1;
  uint64_t tests = 0;
  for (const CheckResult& r : m.results)
    if (r.p_value) p = std::min(p, *r.p_value), ++tests;
  return tests > 0 ? std::optional(sidak_combined(p, tests)) : std::nullopt;
}

// The largest deviation as a share of what is tolerated; 0 where nothing is and nothing was found.
double largest_deviation(const ModelReport& m) {
  double largest = 0;
  for (const CheckResult& r : m.results)
    if (!r.p_value && r.statistic > 0.0) largest = std::max(largest, r.statistic / r.tolerance);
  return largest;
}

}  // namespace

bool ModelReport::passed() const { return all_passed(results); }

bool BatteryRun::passed() const {
  return std::all_of(models.begin(), models.end(), [](const ModelReport& m) { return m.passed(); });
}

BatteryRun run_battery(const std::vector<BatterySubject>& subjects, BatteryOptions options, int threads,
                       const BatteryProgress& progress, const std::atomic<bool>& stop) {
  options.family_level = bonferroni_level(options.family_level, subjects.size());
  struct Slot {
    std::vector<CheckResult> results;
    double seconds = 0;
    bool ran = false;
  };
  std::vector<Slot> slots(subjects.size());
  std::mutex mutex;
  size_t done = 0;
  std::atomic<size_t> next{0};
  Workers(threads).run([&] {
    for (size_t i = next++; i < subjects.size() && !stop; i = next++) {
      const auto start = std::chrono::steady_clock::now();
      slots[i].results = run_subject(subjects[i], options);
      slots[i].seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      slots[i].ran = true;
      const std::lock_guard lock(mutex);
      progress(++done, subjects.size(), subjects[i].family + " " + subjects[i].name);
    }
  });

  BatteryRun run;
  for (size_t i = 0; i < subjects.size(); ++i) {
    if (!slots[i].ran) {
      run.complete = false;
      continue;
    }
    const BatterySubject& s = subjects[i];
    if (run.models.empty() || run.models.back().family != s.family || run.models.back().model != s.model)
      run.models.push_back({s.family, s.model, 0, {}, 0});
    ModelReport& m = run.models.back();
    ++m.settings;
    m.seconds += slots[i].seconds;
    std::move(slots[i].results.begin(), slots[i].results.end(), std::back_inserter(m.results));
  }
  return run;
}

std::string battery_table(const BatteryRun& run, bool details) {
  size_t family = 6, model = 5;
  for (const ModelReport& m : run.models)
    family = std::max(family, m.family.size()), model = std::max(model, m.model.size());
  std::string text = fmt::format("{:{}}  {:{}}  {:>8}  {:>6}  {:>10}  {:>9}  {:>7}  {}\n", "family", family, "model",
                                 model, "settings", "checks", "smallest p", "deviation", "seconds", "verdict");
  for (const ModelReport& m : run.models) {
    const auto p = smallest_p(m);
    text += fmt::format("{:{}}  {:{}}  {:>8}  {:>6}  {:>10}  {:>9.2f}  {:>7.1f}  {}\n", m.family, family, m.model,
                        model, m.settings, m.results.size(), p ? fmt::format("{:.2g}", *p) : "-", largest_deviation(m),
                        m.seconds, m.passed() ? "ok" : "FAILED");
  }
  size_t settings = 0, checks = 0, failed = 0;
  for (const ModelReport& m : run.models) {
    settings += m.settings, checks += m.results.size();
    for (const CheckResult& r : m.results) {
      if (details || !r.passed) text += to_string(r) + "\n";
      failed += r.passed ? 0 : 1;
    }
  }
  return text + fmt::format("{} models, {} settings, {} checks: {}\n", run.models.size(), settings, checks,
                            failed == 0 ? "all passed" : fmt::format("{} FAILED", failed));
}

std::string battery_json(const BatteryRun& run) {
  nlohmann::ordered_json json;
  json["passed"] = run.passed();
  json["complete"] = run.complete;
  json["models"] = nlohmann::ordered_json::array();
  for (const ModelReport& m : run.models) {
    nlohmann::ordered_json model{{"family", m.family}, {"model", m.model}, {"settings", m.settings}};
    model["passed"] = m.passed();
    model["seconds"] = m.seconds;
    for (const CheckResult& r : m.results) {
      nlohmann::ordered_json check{{"setting", r.subject}, {"check", r.name}, {"passed", r.passed}};
      check["statistic"] = r.statistic;
      if (r.p_value)
        check["p"] = *r.p_value;
      else
        check["tolerance"] = r.tolerance;
      check["text"] = r.text;
      model["checks"].push_back(std::move(check));
    }
    json["models"].push_back(std::move(model));
  }
  return json.dump(2) + "\n";
}

}  // namespace etd
