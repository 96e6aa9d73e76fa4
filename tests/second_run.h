// The second chance of statistical tests. Chance speaks against right code once, a mistake twice: what fails runs again
// with four times the samples and fresh random numbers, and has failed only if that run fails as well. The levels of
// both may therefore be those of repeated_level (verify/statistics/statistics.h), and a mistake that the first run
// finds with some probability is found by the second almost surely, whose error is half as large.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace etd {

// One of the two runs.
struct TestRun {
  uint32_t more = 1;         // factor on the samples
  uint64_t fresh_seeds = 0;  // to be added to every seed
  bool is_first() const { return fresh_seeds == 0; }
};

// What a run has against the code, an entry for each; none if it passes.
using Objections = std::vector<std::string>;

// Runs the test once, or twice. Fails, and shows what both runs object to, if both object. That a test is sharp enough
// is no matter of chance: `run` expects it by itself.
void expect_in_two_runs(const std::string& name, const std::function<Objections(const TestRun&)>& run);

}  // namespace etd
