// What is wrong with one data file. A broken file of a million vertices may have a million problems: the first few tell
// the story, the rest is counted.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace etd {

class ProblemList {
 public:
  static constexpr size_t kShown = 20;

  void add(std::string problem) {
    if (shown_.size() < kShown) {
      shown_.push_back(std::move(problem));
    } else {
      ++more_;
    }
  }
  bool empty() const { return shown_.empty(); }
  // The problems in the order they were found, and "... and N more" where some were only counted.
  std::vector<std::string> take() {
    if (more_ > 0) shown_.push_back(fmt::format("... and {} more", more_));
    more_ = 0;
    return std::exchange(shown_, {});
  }

 private:
  std::vector<std::string> shown_;
  size_t more_ = 0;
};

}  // namespace etd
