// Folds many comparisons into one row of the table: the worst of them, and where it was.
#pragma once

#include <cmath>
#include <string>
#include <utility>

#include "verify/battery/check.h"
#include "verify/statistics/statistics.h"

namespace etd {

// The largest deviation seen. Passes while it is at most `tolerance`.
class Worst {
 public:
  Worst(std::string subject, std::string name, double tolerance) : tolerance_(tolerance) {
    result_.subject = std::move(subject);
    result_.name = std::move(name);
  }
  // `where` is called only for a new maximum. NaN is the worst of all.
  template <class F>
  void add(double deviation, F&& where) {
    if (deviation <= worst_) return;
    worst_ = std::isnan(deviation) ? HUGE_VAL : deviation;
    result_.text = where();
  }
  // a and b relative to the larger of them.
  template <class F>
  void add_relative(double a, double b, F&& where) {
    const double scale = std::max(std::abs(a), std::abs(b));
    add(scale > 0.0 ? std::abs(a - b) / scale : a + b, where);
  }
  CheckResult result() const {
    CheckResult r = result_;
    r.statistic = worst_;
    r.passed = worst_ <= tolerance_;
    r.tolerance = tolerance_;
    return r;
  }

 private:
  CheckResult result_;
  double worst_ = 0, tolerance_;
};

// The smallest p-value of one check in several independent settings, corrected for their number.
class WorstP {
 public:
  WorstP(std::string subject, std::string name)
      : result_{std::move(subject), std::move(name), true, 0.0, 1.0, "", nullptr} {}
  // True when this is the worst so far.
  template <class F>
  bool add(double statistic, double p, F&& text) {
    ++tests_;
    if (p >= *result_.p_value && tests_ > 1) return false;
    result_.statistic = statistic;
    result_.p_value = std::isnan(p) ? 0.0 : p;
    result_.text = text();
    result_.map = nullptr;
    return true;
  }
  // Keeps the map of the worst so far.
  void set_map(CheckMap map) { result_.map = std::make_shared<const CheckMap>(std::move(map)); }
  // Whether anything was compared.
  bool any() const { return tests_ > 0; }
  CheckResult result() const {
    CheckResult r = result_;
    r.p_value = sidak_combined(*r.p_value, tests_);
    return r;
  }

 private:
  CheckResult result_;
  uint64_t tests_ = 0;
};

}  // namespace etd
