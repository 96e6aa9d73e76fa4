#include "render/interrupt.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <thread>

#include "io/pending_file.h"
#include "temp_folder.h"

namespace etd {
namespace {

using namespace std::chrono_literals;

TEST(Interrupts, AreRememberedWithTheirExitCode) {
  for (const auto& [signal_number, code] : {std::pair(SIGINT, 130), std::pair(SIGTERM, 143), std::pair(SIGHUP, 129)}) {
    const InterruptScope scope;
    EXPECT_FALSE(scope.stop());
    EXPECT_EQ(scope.exit_code(), 0);
    raise(signal_number);
    EXPECT_TRUE(scope.stop());
    EXPECT_EQ(scope.exit_code(), code);
  }
}

TEST(Interrupts, OneRequestMayBeSeveralSignals) {
  const InterruptScope scope;
  raise(SIGTERM);
  raise(SIGTERM);  // as `timeout` sends it: to the program, and to its group
  std::this_thread::sleep_for(200ms);
  raise(SIGHUP);
  EXPECT_EQ(scope.exit_code(), 143);
}

TEST(InterruptsDeathTest, ASecondSignalEndsTheProgramAtOnceAndLeavesNoHalfFile) {
  const TempFolder folder;
  const auto path = folder.write("a.txt", "old");
  for (const auto& [second, code] : {std::pair(SIGINT, 130), std::pair(SIGTERM, 143)})
    EXPECT_EXIT(
        {
          const EndOnSignal ending;
          const InterruptScope scope;
          const PendingFile file(path);
          raise(SIGINT);
          std::this_thread::sleep_for(200ms);
          raise(second);
        },
        ::testing::ExitedWithCode(code), "stopping after what runs(.|\n)*ended by SIG(INT|TERM); nothing more is");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(InterruptsDeathTest, BeforeAndAfterWhatIsWorthKeepingTheFirstOneEndsTheProgram) {
  for (const auto& [signal_number, code] : {std::pair(SIGINT, 130), std::pair(SIGTERM, 143), std::pair(SIGHUP, 129)})
    for (const bool before : {true, false})
      EXPECT_EXIT(
          {
            const EndOnSignal ending;
            if (!before) const InterruptScope scope;
            raise(signal_number);
          },
          ::testing::ExitedWithCode(code), "^etendue: ended by SIG(INT|TERM|HUP); nothing more is written");
}

TEST(InterruptsDeathTest, AnIgnoredHangUpStaysIgnored) {
  EXPECT_EXIT(
      {
        signal(SIGHUP, SIG_IGN);
        const EndOnSignal ending;
        raise(SIGHUP);
        const InterruptScope scope;
        raise(SIGHUP);
        _exit(scope.stop() ? 1 : 0);
      },
      ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace etd
