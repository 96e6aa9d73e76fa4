#include "verify/battery/check.h"

#include <fmt/format.h>

#include <algorithm>

#include "verify/statistics/statistics.h"

namespace etd {

void judge(std::span<CheckResult> results, double family_level) {
  const auto is_statistical = [](const CheckResult& r) { return r.p_value.has_value(); };
  const auto tests = std::count_if(results.begin(), results.end(), is_statistical);
  const double level = bonferroni_level(family_level, static_cast<uint64_t>(tests));
  for (CheckResult& r : results)
    if (r.p_value) r.passed = *r.p_value >= level;
}

std::string to_string(const CheckResult& r) {
  const std::string p = r.p_value ? fmt::format("p = {:.3g}", *r.p_value) : "";
  return fmt::format("{:<6} {:<36} {:<28} {:>10.4g}  {:<13} {}", r.passed ? "ok" : "FAILED", r.subject, r.name,
                     r.statistic, p, r.text);
}

}  // namespace etd
