#include "printing.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "commands.h"
#include "render/workers.h"

namespace etd::cli {
namespace {

bool g_answered = false;
int g_failure = 0;  // errno of the first answer that could not be written

}  // namespace

void prepare_standard_streams() {
  std::signal(SIGPIPE, SIG_IGN);  // nobody reads any more
  std::signal(SIGXFSZ, SIG_IGN);  // a file would become longer than the user allows
  // The order matters: a new descriptor is the lowest one that is free. The streams are opened the wrong way round, so
  // that reading and writing fail as they would if the stream were closed.
  for (const auto& [stream, mode] :
       {std::pair(STDIN_FILENO, O_WRONLY), std::pair(STDOUT_FILENO, O_RDONLY), std::pair(STDERR_FILENO, O_RDONLY)})
    if (::fcntl(stream, F_GETFD) < 0) static_cast<void>(::open("/dev/null", mode));
}

void answer_text(std::string_view text) {
  g_answered = true;
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() && g_failure == 0) g_failure = errno;
}

void tell_of_refused_threads() {
  static bool told = false;
  if (told || !threads_were_refused()) return;
  told = true;
  tell("etendue: warning: the system refuses threads; those that can be had do the work, which only takes longer\n");
}

int code_after_answers(int code, int failed) {
  if (std::fflush(stdout) != 0 && g_failure == 0) g_failure = errno;
  if (!g_answered || g_failure == 0 || (code != kOk && code != kCannotTell)) return code;
  // A reader that has seen enough, as in `| head`, is no news.
  if (g_failure != EPIPE) tell("etendue: cannot write to standard output: {}\n", std::strerror(g_failure));
  return failed;
}

}  // namespace etd::cli
