// Block by block against pbrt-v4's grey references in the shared folder: means of eight runs of 128 samples (96 for the
// classroom) with their standard error. Blocks that touch an emitter, or a pixel beside one, are left out; the means of
// all others must agree within their errors and 0.5 %. Of those at most 0.5 % may be excused, each with its cause.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <iostream>

#include "io/picture.h"
#include "render_helper.h"
#include "second_run.h"
#include "shared_path.h"
#include "verify/statistics/compare.h"

namespace etd {
namespace {

struct Excused {
  int x, y;  // the block's first pixel
  const char* cause;
};

struct BlockScene {
  const char* name;
  uint32_t spp;
  double samples;  // of the reference
  std::vector<Excused> excused;
};

constexpr int kBlock = 8;
constexpr double kLevel = 1e-4;

Picture read_grey(const std::filesystem::path& path) {
  const LayersResult read = read_layers(path);
  if (!read.image) throw std::runtime_error(path.string() + ": " + read.error);
  return {read.image->width, read.image->height, layer_rgb(*read.image, "").rgb};
}

Film render_ours(const std::filesystem::path& folder, uint32_t spp, uint64_t seed) {
  RenderOverrides o;
  o.spp = spp, o.replicates = 8, o.seed = seed, o.features = false;
  return render_scene(folder / "reference-grey.pbrt", o);
}

bool touches_emission(const Film& film, const PixelBounds& b) {
  for (int y = std::max(b.y0 - 1, 0); y < std::min(b.y1 + 1, film.settings().height); ++y)
    for (int x = std::max(b.x0 - 1, 0); x < std::min(b.x1 + 1, film.settings().width); ++x)
      if (film.total(x, y).emission != std::array<double, 3>{}) return true;
  return false;
}

struct Blocks {
  size_t tested = 0, excused = 0;
  double error = 0;  // of the median block's difference, relative
  std::vector<RegionTest> failed;
};

Blocks compare_blocks(const BlockScene& scene, const std::filesystem::path& folder, uint32_t spp, uint64_t seed) {
  const Film film = render_ours(folder, spp, seed);
  EstimateResult reference =
      make_estimate(read_grey(folder / "reference-grey.exr"), read_grey(folder / "reference-grey-stderr.exr"), 8);
  if (!reference.estimate) throw std::runtime_error(reference.problem);
  reference.estimate->samples = scene.samples;
  const Verdict v = compare(make_estimate(film), *reference.estimate, {.tolerance = 0.005, .block = kBlock});
  Blocks blocks;
  std::vector<RegionTest> tests;
  for (const RegionTest& t : v.blocks)  // the channels of grey scenes say the same thing
    if (t.channel == 1 && !touches_emission(film, t.region)) tests.push_back(t);
  std::vector<double> p, errors;
  for (const RegionTest& t : tests) p.push_back(t.result.p_value), errors.push_back(t.error / t.b);
  if (tests.empty()) return blocks;
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2), errors.end());
  blocks.error = errors[errors.size() / 2];
  const std::vector<double> corrected = holm_corrected(p);
  blocks.tested = tests.size();
  for (size_t i = 0; i < tests.size(); ++i) {
    if (corrected[i] >= kLevel) continue;
    const PixelBounds& r = tests[i].region;
    const bool excused = std::any_of(scene.excused.begin(), scene.excused.end(),
                                     [&r](const Excused& e) { return e.x == r.x0 && e.y == r.y0; });
    if (excused)
      ++blocks.excused;
    else
      blocks.failed.push_back(tests[i]);
  }
  return blocks;
}

// False alarms: kLevel for each scene, squared because a failure is repeated (second_run.h).
void expect_blocks(const BlockScene& scene, uint32_t more = 1) {
  const std::filesystem::path folder = shared_path(std::string("scenes/pbrt/") + scene.name);
  if (folder.empty()) GTEST_SKIP() << "the shared folder with the scene " << scene.name << " is absent";
  expect_in_two_runs(scene.name, [&](const TestRun& run) {
    const Blocks blocks = compare_blocks(scene, folder, scene.spp * more * run.more, 11 + run.fresh_seeds);
    std::cout << fmt::format("{:12} {} blocks, {} excused, {} differ; median standard error {:.2f} %\n", scene.name,
                             blocks.tested, blocks.excused, blocks.failed.size(), 100 * blocks.error);
    EXPECT_GT(blocks.tested, 100u);
    EXPECT_LE(static_cast<double>(scene.excused.size()), 0.005 * static_cast<double>(blocks.tested));
    Objections differences;
    for (const RegionTest& t : blocks.failed)
      differences.push_back(fmt::format("block at {},{}: ours {:.5f}, theirs {:.5f}, t = {:.2f}, p = {:.2g}",
                                        t.region.x0, t.region.y0, t.a, t.b, t.result.statistic, t.result.p_value));
    return differences;
  });
}

const BlockScene kCornellBox{"cornell-box", 16, 1024, {}}, kVeachMis{"veach-mis", 64, 1024, {}},
    kVeachAjar{"veach-ajar", 16, 1024, {}}, kTeapot{"teapot", 16, 1024, {}}, kClassroom{"classroom", 16, 768, {}};

TEST(StatisticalReferenceBlocks, CornellBox) { expect_blocks(kCornellBox); }
TEST(StatisticalReferenceBlocks, VeachMis) { expect_blocks(kVeachMis); }
TEST(StatisticalReferenceBlocks, VeachAjar) { expect_blocks(kVeachAjar); }
TEST(StatisticalReferenceBlocks, Teapot) { expect_blocks(kTeapot); }

TEST(SlowReferenceBlocks, CornellBox) { expect_blocks(kCornellBox, 16); }
TEST(SlowReferenceBlocks, VeachMis) { expect_blocks(kVeachMis, 16); }
TEST(SlowReferenceBlocks, VeachAjar) { expect_blocks(kVeachAjar, 16); }
TEST(SlowReferenceBlocks, Teapot) { expect_blocks(kTeapot, 16); }
TEST(SlowReferenceBlocks, Classroom) { expect_blocks(kClassroom, 16); }

}  // namespace
}  // namespace etd
