#include "render/interrupt.h"

#include <signal.h>

#include <cassert>

namespace etd {
namespace {

// A handler may only touch lock-free atomics and call async-signal-safe functions (POSIX.1-2017, 2.4.3).
std::atomic<bool> g_stop{false};
std::atomic<int> g_signal{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

struct sigaction g_former_int, g_former_term;
std::atomic<bool> g_in_use{false};

extern "C" void remember_signal(int signal_number) {
  g_signal = signal_number;
  g_stop = true;
  // The next one, of either kind, meets the default action and ends the program.
  signal(SIGINT, SIG_DFL);
  signal(SIGTERM, SIG_DFL);
}

}  // namespace

InterruptScope::InterruptScope() {
  [[maybe_unused]] const bool nested = g_in_use.exchange(true);
  assert(!nested);
  g_stop = false;
  g_signal = 0;
  struct sigaction action = {};
  action.sa_handler = remember_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, &g_former_int);
  sigaction(SIGTERM, &action, &g_former_term);
}

InterruptScope::~InterruptScope() {
  sigaction(SIGINT, &g_former_int, nullptr);
  sigaction(SIGTERM, &g_former_term, nullptr);
  g_in_use = false;
}

const std::atomic<bool>& InterruptScope::stop() const { return g_stop; }

int InterruptScope::exit_code() const { return g_signal == 0 ? 0 : 128 + g_signal; }

}  // namespace etd
