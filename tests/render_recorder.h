// Watches a render, and may stop it.
#pragma once

#include <algorithm>
#include <atomic>
#include <mutex>
#include <vector>

#include "render/driver.h"

namespace etd {

class RenderRecorder : public RenderObserver {
 public:
  explicit RenderRecorder(std::atomic<bool>& stop, double stop_at) : stop_(stop), stop_at_(stop_at) {}
  void on_progress(const RenderProgress& p) override {
    const std::lock_guard lock(mutex_);
    highest = std::max(highest, p.spp_done);
    if (p.spp_done >= stop_at_) stop_ = true;
  }
  void on_pass_end(const RenderProgress& p) override { pass_ends.push_back(p.spp_done); }
  double highest = 0;
  std::vector<double> pass_ends;

 private:
  std::mutex mutex_;
  std::atomic<bool>& stop_;
  double stop_at_;
};

}  // namespace etd
