// How many threads work: one object around whatever runs in parallel.
#pragma once

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <thread>

namespace etd {

// 0 means all cores.
inline int thread_count(int requested) {
  return requested > 0 ? requested : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

// Runs parallel work on the given number of threads, even when that is more than there are cores.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads)
      : count_(thread_count(threads)),
        control_(tbb::global_control::max_allowed_parallelism, static_cast<size_t>(count_)),
        arena_(count_) {}

  int count() const { return count_; }

  template <class F>
  auto run(F&& f) {
    return arena_.execute(std::forward<F>(f));
  }

 private:
  int count_;
  tbb::global_control control_;
  tbb::task_arena arena_;
};

}  // namespace etd
