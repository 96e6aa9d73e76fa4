// How many of many tasks are done, on a terminal; nothing where there is none.
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <string>

#include "printing.h"

namespace etd::cli {

class TaskBar {
 public:
  explicit TaskBar(bool quiet) : shown_(!quiet && isatty(fileno(stderr)) != 0) {}
  ~TaskBar() { clear(); }
  TaskBar(const TaskBar&) = delete;
  TaskBar& operator=(const TaskBar&) = delete;

  void show(double share, const std::string& text) {
    if (!shown_) return;
    constexpr size_t kWidth = 24, kTextWidth = 60;
    const auto filled = static_cast<size_t>(share * kWidth + 0.5);
    const std::string line = fmt::format("[{}{}] {:3.0f} % {:.{}}", std::string(filled, '#'),
                                         std::string(kWidth - filled, '.'), 100 * share, text, kTextWidth);
    tell("\r{:<{}}", line, drawn_);
    std::fflush(stderr);
    drawn_ = line.size();
  }
  void clear() {
    if (drawn_ > 0) tell("\r{:{}}\r", "", drawn_);
    drawn_ = 0;
  }

 private:
  bool shown_;
  size_t drawn_ = 0;  // characters on the terminal
};

}  // namespace etd::cli
