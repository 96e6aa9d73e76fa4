// Signals that ask the program to end: SIGINT (Ctrl-C), SIGTERM, and SIGHUP unless it is ignored (nohup).
#pragma once

#include <atomic>

namespace etd {

// While it lives, such a signal ends the program at once: with a message, without half a file, and with the exit code
// that shells give to a signal (128 + its number). For the start of a program, before anything is worth keeping.
class EndOnSignal {
 public:
  EndOnSignal();
  ~EndOnSignal();
  EndOnSignal(const EndOnSignal&) = delete;
  EndOnSignal& operator=(const EndOnSignal&) = delete;
};

// While it lives, the first signal is a polite request: what runs is finished and written, and the exit code says what
// happened. A second one ends the program at once, as above, unless it belongs to the first: SIGHUP never counts as a
// second one, since a terminal that is closed sends several, nor does what comes within a tenth of a second, since
// programs like `timeout` pass on what the terminal sends as well. One at a time.
class InterruptScope {
 public:
  InterruptScope();
  ~InterruptScope();
  InterruptScope(const InterruptScope&) = delete;
  InterruptScope& operator=(const InterruptScope&) = delete;

  // Becomes true with the first signal.
  const std::atomic<bool>& stop() const;
  // 130 after SIGINT, 143 after SIGTERM, 129 after SIGHUP (128 + its number), 0 when none came.
  int exit_code() const;
};

}  // namespace etd
