// How far the loading of a scene is, on a terminal.
#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>

#include "core/loading.h"
#include "task_bar.h"

namespace etd::cli {

class LoadBar {
 public:
  explicit LoadBar(bool quiet) : bar_(quiet) {}

  // The monitor of a loading that ends when `stop`, if there is one, becomes true. The bar must outlive it.
  LoadMonitor monitor(const std::atomic<bool>* stop) {
    return [this, stop](std::string_view what, double share) {
      show(what, share);
      return !(stop && *stop);
    };
  }
  void show(std::string_view what, double share) {
    constexpr std::chrono::milliseconds kRedrawInterval{200};
    // Whoever finds another thread here has nothing newer to say.
    const std::unique_lock lock(mutex_, std::try_to_lock);
    const auto now = std::chrono::steady_clock::now();
    if (!lock || now - last_ < kRedrawInterval) return;
    last_ = now;
    bar_.show(share, std::string(what));
  }
  void clear() {
    const std::lock_guard lock(mutex_);
    bar_.clear();
    last_ = {};
  }

 private:
  TaskBar bar_;
  std::mutex mutex_;
  std::chrono::steady_clock::time_point last_{};  // that it was drawn
};

}  // namespace etd::cli
