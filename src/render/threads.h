// How many threads oneTBB uses, which Embree builds with.
#pragma once

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "render/workers.h"

namespace etd {

// Runs what is parallel inside of oneTBB on the given number of threads, even when that is more than there are cores.
// oneTBB ends the program when the system refuses it a thread. So it is allowed some only where twice as many can be
// had: those that were tried may not have gone yet when it starts its own.
class TbbThreads {
 public:
  explicit TbbThreads(int threads)
      : count_(can_have_threads(2 * (thread_count(threads) - 1)) ? thread_count(threads) : 1),
        control_(tbb::global_control::max_allowed_parallelism, static_cast<size_t>(count_)),
        arena_(count_) {}

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
