#include "render/interrupt.h"

#include <poll.h>
#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <cstring>

#include "io/pending_file.h"

namespace etd {
namespace {

constexpr std::array<int, 3> kSignals = {SIGINT, SIGTERM, SIGHUP};
constexpr int64_t kOneRequestMilliseconds = 100;

// A handler may only touch lock-free atomics and call async-signal-safe functions (POSIX.1-2017, 2.4.3).
std::atomic<bool> g_stop{false}, g_polite{false};
std::atomic<int> g_signal{0};
std::atomic<int64_t> g_first_milliseconds{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int64_t>::is_always_lock_free);

int g_scopes = 0;
bool g_terminal = false;  // where a progress bar may stand in the line
std::array<struct sigaction, kSignals.size()> g_former;

int64_t milliseconds() {
  timespec now = {};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return int64_t{now.tv_sec} * 1000 + now.tv_nsec / 1000000;
}

// Says it if that is possible at once: nobody may be reading.
void say(const char* text) {
  pollfd err{STDERR_FILENO, POLLOUT, 0};
  if (::poll(&err, 1, 0) != 1 || (err.revents & POLLOUT) == 0) return;
  if (g_terminal) static_cast<void>(!::write(STDERR_FILENO, "\n", 1));
  static_cast<void>(!::write(STDERR_FILENO, text, std::strlen(text)));
}

void end_at_once(int signal_number) {
  say(signal_number == SIGINT    ? "etendue: ended by SIGINT; nothing more is written\n"
      : signal_number == SIGTERM ? "etendue: ended by SIGTERM; nothing more is written\n"
                                 : "etendue: ended by SIGHUP; nothing more is written\n");
  remove_pending_files();
  ::_exit(128 + signal_number);
}

extern "C" void on_signal(int signal_number) {
  const int former_errno = errno;
  int none = 0;
  if (!g_polite) {
    end_at_once(signal_number);
  } else if (g_signal.compare_exchange_strong(none, signal_number)) {
    g_first_milliseconds = milliseconds();
    g_stop = true;
    say("etendue: stopping after what runs; a second Ctrl-C ends at once\n");
  } else if (signal_number != SIGHUP && milliseconds() - g_first_milliseconds > kOneRequestMilliseconds) {
    end_at_once(signal_number);
  }
  errno = former_errno;
}

void install() {
  if (g_scopes++ > 0) return;
  g_terminal = ::isatty(STDERR_FILENO) != 0;
  struct sigaction action = {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int s : kSignals) sigaddset(&action.sa_mask, s);
  for (size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], nullptr, &g_former[i]);
    if (kSignals[i] == SIGHUP && g_former[i].sa_handler == SIG_IGN) continue;
    sigaction(kSignals[i], &action, nullptr);
  }
}

void restore() {
  if (--g_scopes > 0) return;
  for (size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &g_former[i], nullptr);
}

}  // namespace

EndOnSignal::EndOnSignal() { install(); }
EndOnSignal::~EndOnSignal() { restore(); }

InterruptScope::InterruptScope() {
  assert(!g_polite);
  g_stop = false;
  g_signal = 0;
  g_polite = true;
  install();
}

InterruptScope::~InterruptScope() {
  restore();
  g_polite = false;
}

const std::atomic<bool>& InterruptScope::stop() const { return g_stop; }

int InterruptScope::exit_code() const { return g_signal == 0 ? 0 : 128 + g_signal; }

}  // namespace etd
