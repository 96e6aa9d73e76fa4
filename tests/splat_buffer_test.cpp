// Sums in fixed point: exact, and the same in every order and on any number of threads.
#include "film/splat_buffer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>
#include <vector>

#include "core/hash.h"

namespace etd {
namespace {

TEST(SplatBuffer, KeepsWhatIsAdded) {
  for (const double v : {0.0, 1.0, -1.0, 0.5, -0.75, 1e-18, -1e-18, 3.7e8, -3.7e8, 0x1p60, -0x1p60, 1.0 / 3.0}) {
    SplatBuffer buffer(2);
    buffer.add(1, v);
    EXPECT_NEAR(buffer.take(1), v, 0x1p-64) << v;
    EXPECT_EQ(buffer.take(1), 0.0) << v;
    EXPECT_EQ(buffer.take(0), 0.0) << v;
    // Fractions that make up more than a whole together.
    for (int i = 0; i < 3; ++i) buffer.add(0, v);
    EXPECT_NEAR(buffer.take(0), 3 * v, 0x1p-50 * std::abs(v) + 0x1p-62) << v;
  }
}

TEST(SplatBuffer, SmallValuesAreNotLostBesideLargeOnes) {
  SplatBuffer buffer(1);
  buffer.add(0, 0x1p50);
  for (int i = 0; i < 1000; ++i) buffer.add(0, 1e-15);
  buffer.add(0, -0x1p50);
  EXPECT_NEAR(buffer.take(0), 1e-12, 1000 * 0x1p-64);
}

TEST(SplatBuffer, OrderAndThreadsChangeNoBit) {
  std::vector<double> values;
  HashStream numbers(3);
  for (int i = 0; i < 40000; ++i)
    values.push_back((static_cast<double>(numbers.next_float()) - 0.3) *
                     std::exp2(60.0 * static_cast<double>(numbers.next_float()) - 30.0));
  SplatBuffer forwards(1), together(1);
  for (const double v : values) forwards.add(0, v);
  std::vector<std::thread> threads;
  for (size_t t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (size_t i = values.size(); i-- > 0;)
        if (i % 4 == t) together.add(0, values[i]);
    });
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(forwards.take(0), together.take(0));
}

}  // namespace
}  // namespace etd
