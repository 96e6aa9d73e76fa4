// How far a render is, on a terminal: a bar that redraws itself a few times a second, or plain lines in a log file.
#pragma once

#include <chrono>
#include <cstdio>
#include <mutex>
#include <string>

#include "render/driver.h"

namespace etd {

// "1.25 M", "830 k": three significant digits and the unit prefix.
std::string short_count(double count);
// "0:07", "1:02:30".
std::string clock_text(double seconds);
// "1.2 %", or "unknown" when it is not finite.
std::string error_text(double error);
// "24/64 spp, error 3.1 %, 5.2 Mrays/s, 0:12 left"; "24 spp, ..." when samples are unlimited.
std::string progress_text(const RenderProgress& progress);

class ProgressPrinter : public RenderObserver {
 public:
  // `redraw`: out is a terminal. Otherwise a line is printed when another tenth of the samples is done.
  // `label`, if there is one, says what is rendered.
  ProgressPrinter(std::FILE* out, bool redraw, std::string label = {})
      : out_(out), redraw_(redraw), label_(label.empty() ? label : label + "  ") {}
  ~ProgressPrinter() override { finish(); }

  void on_progress(const RenderProgress& progress) override;
  void on_pass_end(const RenderProgress& progress) override;
  // Clears the bar, so that other lines can follow.
  void finish();

 private:
  void print_line(const RenderProgress& progress);
  void draw(const RenderProgress& progress);

  std::FILE* out_;
  bool redraw_;
  std::string label_;
  std::mutex mutex_;
  std::chrono::steady_clock::time_point last_{};
  size_t drawn_ = 0;  // characters of the bar on the terminal
  int tenths_ = 0;    // printed, when not redrawing
};

}  // namespace etd
