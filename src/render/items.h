// Runs independent items on all threads: the one parallel loop of this room.
#pragma once

#include <atomic>

#include "core/flush_to_zero.h"
#include "render/workers.h"

namespace etd {

// Calls f(i) for i = next, next + 1, ... below n, begun in this order, each on whichever thread is free. After a call
// that returns false no other one is begun; `next` is then the first that was not (n or more: none), so that a second
// call goes on from there. Items run with flush-to-zero set. An exception stops the others in the same way and passes
// through.
template <class F>
void run_items(Workers& workers, std::atomic<size_t>& next, size_t n, F f) {
  std::atomic<bool> halted{false};
  workers.run([&] {
    const FlushToZero flush;
    try {
      while (!halted) {
        const size_t i = next++;
        if (i >= n) return;
        if (!f(i)) halted = true;
      }
    } catch (...) {
      halted = true;
      throw;
    }
  });
}

// All items from 0 to n - 1.
template <class F>
void for_each_item(Workers& workers, size_t n, F f) {
  std::atomic<size_t> next{0};
  run_items(workers, next, n, [&f](size_t i) { return f(i), true; });
}

}  // namespace etd
