#include "render/progress.h"

#include <gtest/gtest.h>

#include <memory>

namespace etd {
namespace {

TEST(Progress, TextsArePlain) {
  EXPECT_EQ(short_count(0), "0.00 ");
  EXPECT_EQ(short_count(999.4), "999 ");
  EXPECT_EQ(short_count(999.7), "1.00 k");
  EXPECT_EQ(short_count(1.2345e6), "1.23 M");
  EXPECT_EQ(short_count(45.67e6), "45.7 M");
  EXPECT_EQ(clock_text(7.4), "0:07");
  EXPECT_EQ(clock_text(3750), "1:02:30");
  EXPECT_EQ(clock_text(HUGE_VAL), "0:00");
  EXPECT_EQ(error_text(0.0312), "3.1 %");
  EXPECT_EQ(error_text(HUGE_VAL), "unknown");
  EXPECT_EQ(progress_text({64, 16.5, 30000000, 5.0, 0.031, 16.5 / 64}),
            "16/64 spp, error 3.1 %, 6.00 Mrays/s, 0:14 left");
  EXPECT_EQ(progress_text({64, 64, 30000000, 5.0, 0.031, 1}), "64/64 spp, error 3.1 %, 6.00 Mrays/s");
  EXPECT_EQ(progress_text({kMaxSpp, 64, 30000000, 5.0, 0.031, 0.5}), "64 spp, error 3.1 %, 6.00 Mrays/s, 0:05 left");
}

// What a printer writes while a render of 100 spp goes from 1 to 100.
std::string written(bool redraw) {
  std::FILE* file = std::tmpfile();
  {
    ProgressPrinter printer(file, redraw);
    for (int spp = 1; spp <= 100; ++spp) {
      const RenderProgress p{100, static_cast<double>(spp), 1000, 1.0, 0.5, spp / 100.0};
      printer.on_progress(p);
      if (spp % 25 == 0) printer.on_pass_end(p);
    }
  }
  std::string text(static_cast<size_t>(std::ftell(file)), ' ');
  std::rewind(file);
  EXPECT_EQ(std::fread(text.data(), 1, text.size(), file), text.size());
  std::fclose(file);
  return text;
}

TEST(Progress, LogFilesGetALineForEachTenth) {
  const std::string text = written(false);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10);
  EXPECT_EQ(text.find('\r'), std::string::npos);
  EXPECT_EQ(text.find(" 10 %  10/100 spp"), 0u) << text;
  EXPECT_NE(text.find("100 %  100/100 spp"), std::string::npos) << text;
}

TEST(Progress, TerminalsGetABarThatIsThrottledAndCleared) {
  const std::string text = written(true);
  EXPECT_EQ(text.find('\n'), std::string::npos);
  EXPECT_NE(text.find("\r[########################] 100/100 spp"), std::string::npos) << text;
  EXPECT_EQ(text.back(), '\r');
  EXPECT_LE(std::count(text.begin(), text.end(), '['), 6);
}

}  // namespace
}  // namespace etd
