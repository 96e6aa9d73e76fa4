#include "verify/battery.h"

#include <algorithm>

#include "core/hash.h"

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
  options.family_level *= 0.5;
  std::vector<CheckResult> results = subject.check(options);
  const bool failed = std::any_of(results.begin(), results.end(), [](const auto& r) { return !r.passed; });
  const bool certain =
      std::any_of(results.begin(), results.end(), [](const auto& r) { return !r.passed && !r.p_value; });
  if (!failed || certain) return results;
  options.samples *= 4.0;
  options.seed = hash_combine(options.seed, 4);
  results = subject.check(options);
  for (CheckResult& r : results)
    if (r.p_value) r.text = "second run, four times the samples: " + r.text;
  return results;
}

}  // namespace etd
