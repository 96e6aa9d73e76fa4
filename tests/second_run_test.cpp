#include "second_run.h"

#include <gtest/gtest-spi.h>

namespace etd {
namespace {

TEST(SecondRun, IsForWhatFailsAndDecides) {
  std::vector<uint32_t> samples;
  const auto test = [&samples](bool first_objects, bool second_objects) {
    expect_in_two_runs("test", [&](const TestRun& run) {
      samples.push_back(run.more);
      const bool objects = run.is_first() ? first_objects : second_objects;
      return objects ? Objections{run.is_first() ? "p = 1e-5" : "p = 1e-9"} : Objections{};
    });
    return std::exchange(samples, {});
  };
  EXPECT_EQ(test(false, true), (std::vector<uint32_t>{1}));
  EXPECT_EQ(test(true, false), (std::vector<uint32_t>{1, 4}));
  testing::TestPartResultArray failures;
  {
    const testing::ScopedFakeTestPartResultReporter reporter(&failures);
    test(true, true);
  }
  ASSERT_EQ(failures.size(), 1);
  const std::string message = failures.GetTestPartResult(0).message();
  for (const char* part : {"first run:\n  p = 1e-5", "four times the samples:\n  p = 1e-9"})
    EXPECT_NE(message.find(part), std::string::npos) << message;
}

}  // namespace
}  // namespace etd
