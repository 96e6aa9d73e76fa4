#include "render/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/print.h"

namespace etd {
namespace {

constexpr int kBarWidth = 24;
constexpr std::chrono::milliseconds kRedrawInterval{200};

}  // namespace

std::string short_count(double count) {
  const char* prefix = "";
  for (const char* next : {" k", " M", " G", " T"}) {
    if (count < 999.5) break;
    count /= 1000;
    prefix = next;
  }
  return fmt::format("{:.{}f}{}", count, count < 9.995 ? 2 : count < 99.95 ? 1 : 0, *prefix ? prefix : " ");
}

std::string clock_text(double seconds) {
  const long s = std::isfinite(seconds) && seconds < 1e9 ? std::lround(seconds) : 0;
  if (s >= 3600) return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
  return fmt::format("{}:{:02}", s / 60, s % 60);
}

std::string error_text(double error) {
  return std::isfinite(error) ? fmt::format("{:.2g} %", 100 * error) : std::string("unknown");
}

std::string progress_text(const RenderProgress& p) {
  std::string text = fmt::format("{:.0f}", std::floor(p.spp_done));
  if (p.spp < kMaxSpp / 2) text += fmt::format("/{}", p.spp);  // more is no limit
  text += fmt::format(" spp, error {}", error_text(p.error));
  if (p.seconds > 0) text += fmt::format(", {}rays/s", short_count(static_cast<double>(p.rays) / p.seconds));
  if (p.share > 0 && p.share < 1) text += fmt::format(", {} left", clock_text(p.seconds * (1 / p.share - 1)));
  return text;
}

void ProgressPrinter::on_progress(const RenderProgress& progress) {
  // Whoever finds another thread here has nothing newer to say.
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) return;
  if (!redraw_)
    print_line(progress);
  else if (std::chrono::steady_clock::now() - last_ >= kRedrawInterval)
    draw(progress);
}

void ProgressPrinter::on_pass_end(const RenderProgress& progress) {
  const std::lock_guard lock(mutex_);
  redraw_ ? draw(progress) : print_line(progress);
}

void ProgressPrinter::print_line(const RenderProgress& progress) {
  const int tenths = static_cast<int>(10 * progress.share);
  if (tenths <= tenths_) return;
  tenths_ = tenths;
  print_or_drop(out_, "{}{:3} %  {}\n", label_, 10 * tenths, progress_text(progress));
  std::fflush(out_);
}

void ProgressPrinter::draw(const RenderProgress& progress) {
  last_ = std::chrono::steady_clock::now();
  const auto filled = static_cast<size_t>(std::lround(kBarWidth * progress.share));
  const std::string line = fmt::format("{}[{}{}] {}", label_, std::string(filled, '#'),
                                       std::string(kBarWidth - filled, '.'), progress_text(progress));
  print_or_drop(out_, "\r{:<{}}", line, drawn_);
  std::fflush(out_);
  drawn_ = line.size();
}

void ProgressPrinter::finish() {
  const std::lock_guard lock(mutex_);
  if (drawn_ == 0) return;
  print_or_drop(out_, "\r{:{}}\r", "", drawn_);
  std::fflush(out_);
  drawn_ = 0;
}

}  // namespace etd
