#include "verify/battery/battery.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/hash.h"
#include "verify/statistics/statistics.h"

namespace etd {

std::vector<BatterySubject> battery_subjects() {
  std::vector<BatterySubject> all;
  for (const auto family : {material_subjects, bsdf_subjects, light_subjects, light_sampler_subjects, phase_subjects,
                            texture_subjects, camera_subjects, filter_subjects, sampler_subjects, warp_subjects}) {
    std::vector<BatterySubject> some = family();
    std::move(some.begin(), some.end(), std::back_inserter(all));
  }
  return all;
}

std::vector<CheckResult> run_subject(const BatterySubject& subject, BatteryOptions options) {
  options.family_level = repeated_level(options.family_level, 1, 1);
  const std::vector<CheckResult> first = subject.check(options);
  const bool failed = std::any_of(first.begin(), first.end(), [](const auto& r) { return !r.passed; });
  const bool certain = std::any_of(first.begin(), first.end(), [](const auto& r) { return !r.passed && !r.p_value; });
  if (!failed || certain) return first;
  options.samples *= 4.0;
  options.seed = hash_combine(options.seed, 4);
  std::vector<CheckResult> second = subject.check(options);
  for (CheckResult& r : second) {
    if (!r.p_value) continue;
    const auto before =
        std::find_if(first.begin(), first.end(), [&r](const CheckResult& f) { return f.name == r.name && f.p_value; });
    r.text =
        fmt::format("second run, four times the samples{}: {}",
                    before != first.end() ? fmt::format(" (first run: p = {:.3g})", *before->p_value) : "", r.text);
  }
  return second;
}

}  // namespace etd
