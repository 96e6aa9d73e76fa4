#include "render/workers.h"

#include <gtest/gtest.h>

#include <atomic>
#include <set>
#include <stdexcept>

#include "render/memory.h"

namespace etd {
namespace {

TEST(Workers, CallTheWorkOnceOnEachThreadRoundAfterRound) {
  for (const int threads : {1, 2, 5}) {
    Workers workers(threads);
    EXPECT_EQ(workers.count(), threads);
    for (int round = 0; round < 100; ++round) {
      std::mutex mutex;
      std::multiset<std::thread::id> who;
      workers.run([&] {
        const std::lock_guard lock(mutex);
        who.insert(std::this_thread::get_id());
      });
      ASSERT_EQ(who.size(), static_cast<size_t>(threads));
      ASSERT_EQ(who.count(std::this_thread::get_id()), 1u);
      ASSERT_EQ(std::set(who.begin(), who.end()).size(), who.size());
    }
  }
}

TEST(Workers, TheFirstExceptionPassesThroughAndTheNextRoundIsAsGoodAsAny) {
  Workers workers(3);
  std::atomic<int> calls{0};
  EXPECT_THROW(workers.run([&] {
    ++calls;
    throw std::runtime_error("no");
  }),
               std::runtime_error);
  EXPECT_EQ(calls, 3);
  workers.run([&] { ++calls; });
  EXPECT_EQ(calls, 6);
}

TEST(Workers, ManyThreadsCanBeHadHere) {
  EXPECT_TRUE(can_have_threads(10));
  EXPECT_FALSE(threads_were_refused());
}

TEST(Memory, APeakIsNoSmallerThanWhatIsHeld) {
  const std::vector<char> held(100 << 20, 'x');
  // The order matters, since reading takes memory too; and kernels count pages in batches for each processor.
  const uint64_t now = memory_bytes();
  EXPECT_GE(now, held.size());
  EXPECT_GE(peak_memory_bytes() + (1 << 20), now);
  EXPECT_LT(peak_memory_bytes(), uint64_t{1} << 40);
}

}  // namespace
}  // namespace etd
