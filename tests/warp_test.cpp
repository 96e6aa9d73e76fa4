// What the battery over warps (verify/battery/warp.cpp) cannot know: that it is complete, and values at the edges.
#include "core/warp.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

#include "render_helper.h"
#include "verify/battery/battery.h"

namespace etd {
namespace {

std::string slurp(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

// Functions and members of core/ whose name begins with "sample", as CLASS::NAME.
std::set<std::string> sampling_functions() {
  std::set<std::string> names;
  const std::regex outer("^(?:class|struct) (\\w+)[^;]*\\{"), function("\\b(sample\\w*)\\((?:Vec2|double|float) u\\b");
  for (const auto& file : std::filesystem::directory_iterator(source_path("src/core"))) {
    if (file.path().extension() != ".h") continue;
    std::istringstream in(slurp(file.path()));
    std::string scope;
    for (std::string line; std::getline(in, line);) {
      std::smatch match;
      if (std::regex_search(line, match, outer)) scope = match[1].str() + "::";
      if (line == "};") scope.clear();
      const bool comment = line.find("//") < line.find("sample");
      if (!comment && std::regex_search(line, match, function)) names.insert(scope + match[1].str());
    }
  }
  return names;
}

// The battery over warps tests what is in its list; this tests that a new one is.
TEST(Warp, EveryOneInCoreIsInTheBattery) {
  std::set<std::string> tested;
  for (const BatterySubject& s : warp_subjects()) tested.insert(s.model);
  const std::set<std::string> present = sampling_functions();
  EXPECT_GE(present.size(), 9u);
  for (const std::string& name : present)
    EXPECT_TRUE(tested.count(name)) << name << " is in no list of verify/battery/warp.cpp";
}

TEST(Warp, ValuesAtTheMiddleAndBelowTheHorizon) {
  EXPECT_EQ(sample_disk_concentric({0.5f, 0.5f}), (Vec2{0, 0}));
  EXPECT_EQ(pdf_hemisphere_cosine(-0.5f), 0.0f);
  for (Vec2 u : {Vec2{0, 0}, Vec2{kOneMinusEpsilon, 0}, Vec2{0.3f, 0.9f}, Vec2{kOneMinusEpsilon, kOneMinusEpsilon}}) {
    const Vec2 b = sample_triangle_uniform(u);
    EXPECT_TRUE(b.x >= 0.0f && b.y >= 0.0f && b.x + b.y <= 1.0f);
  }
}

TEST(Warp, StaysOnItsDomainAtTheCorners) {
  for (float x : {0.0f, 0.5f, kOneMinusEpsilon}) {
    for (float y : {0.0f, 0.5f, kOneMinusEpsilon}) {
      EXPECT_NEAR(length(sample_hemisphere_cosine({x, y})), 1.0f, 1e-6f);
      EXPECT_GE(sample_hemisphere_cosine({x, y}).z, 0.0f);
      EXPECT_NEAR(length(sample_sphere_uniform({x, y})), 1.0f, 1e-6f);
    }
  }
}

}  // namespace
}  // namespace etd
