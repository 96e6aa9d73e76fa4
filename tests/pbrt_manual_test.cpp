// docs/formats/pbrt.md is what the program says of itself. With ETENDUE_UPDATE_EXPECTED set, the file is rewritten.
#include "formats/pbrt/manual.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "places.h"

namespace etd {
namespace {

TEST(PbrtManual, IsUpToDate) {
  const std::filesystem::path path = source_path("docs/formats/pbrt.md");
  const std::string text = pbrt_coverage_markdown();
  if (std::getenv("ETENDUE_UPDATE_EXPECTED")) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
    return;
  }
  std::ifstream in(path, std::ios::binary);
  const std::string committed{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  EXPECT_EQ(text, committed) << "run this test with ETENDUE_UPDATE_EXPECTED=1 and commit docs/formats/pbrt.md";
}

}  // namespace
}  // namespace etd
