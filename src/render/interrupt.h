// Ctrl-C and SIGTERM as a polite request: what runs is finished and written, and the exit code says what happened. A
// second signal ends the program at once.
#pragma once

#include <atomic>

namespace etd {

// Catches SIGINT and SIGTERM while it lives, and gives the signals their former meaning afterwards. One at a time.
class InterruptScope {
 public:
  InterruptScope();
  ~InterruptScope();
  InterruptScope(const InterruptScope&) = delete;
  InterruptScope& operator=(const InterruptScope&) = delete;

  // Becomes true with the first signal.
  const std::atomic<bool>& stop() const;
  // 130 after SIGINT, 143 after SIGTERM (128 + the signal's number, as shells have it), 0 when none came.
  int exit_code() const;
};

}  // namespace etd
