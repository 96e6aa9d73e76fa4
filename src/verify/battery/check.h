// What a check of the battery reports: a row of a table, with the evidence when it fails.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace etd {

// Two maps over one domain that are equal but for noise if the check passes; rows from the top.
struct CheckMap {
  int width = 0, height = 0;
  std::vector<float> sampled, expected;  // densities, of the same scale
  std::vector<float> sigmas;             // sampled - expected in standard deviations
  std::string axes;                      // what runs down and to the right
};

struct CheckResult {
  std::string subject;  // the model, with its parameters
  std::string name;     // what was checked
  bool passed = false;
  double statistic = 0;           // of a statistical check its test statistic, otherwise the largest deviation
  std::optional<double> p_value;  // of statistical checks only
  std::string text;               // where the worst was found; of a failure, the evidence
  std::shared_ptr<const CheckMap> map = {};  // of the worst, where there is one
  double tolerance = 0;                      // of others: the largest deviation that passes
};

// Decides the statistical ones among `results`, so that all of them together raise a false alarm with a probability of
// at most `family_level`. The others keep their verdict.
void judge(std::span<CheckResult> results, double family_level);

// "ok" or "FAILED", subject, name, statistic, p-value and text on a line; evidence of failures below it.
std::string to_string(const CheckResult& result);

}  // namespace etd
