// The same bits for any number of threads, tile size and crop.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "render_helper.h"
#include "same_bits.h"

namespace etd {
namespace {

constexpr int kWidth = 41, kHeight = 30;  // no multiple of any tile size
const char* const kScene = "tests/scenes/agree/glass_caustic.pbrt";

RenderOverrides overrides(int threads, int tile_size, uint32_t replicates) {
  RenderOverrides o;
  o.size = {kWidth, kHeight};
  o.spp = 12;
  o.seed = 3;
  o.threads = threads;
  o.tile_size = tile_size;
  o.replicates = replicates;
  return o;
}

Film render_bits(const RenderOverrides& o) { return render_scene(source_path(kScene), o); }

class Bits : public testing::TestWithParam<uint32_t> {};  // of the number of replicates

TEST_P(Bits, AreTheSameTwice) {
  const RenderOverrides o = overrides(2, 16, GetParam());
  expect_same_bits(render_bits(o), render_bits(o));
}

TEST_P(Bits, DoNotDependOnThreads) {
  const Film one = render_bits(overrides(1, 8, GetParam()));
  for (int threads : {2, 3, 0}) expect_same_bits(one, render_bits(overrides(threads, 8, GetParam())));
}

TEST_P(Bits, DoNotDependOnTheTileSize) {
  const Film sixteen = render_bits(overrides(2, 16, GetParam()));
  for (int tile : {1, 7, 32, 4096}) expect_same_bits(sixteen, render_bits(overrides(2, tile, GetParam())));
}

TEST_P(Bits, DoNotDependOnTheCrop) {
  const Film whole = render_bits(overrides(2, 16, GetParam()));
  for (const PixelBounds& crop : {PixelBounds{5, 3, 24, 20}, PixelBounds{40, 29, 41, 30}, PixelBounds{0, 0, 41, 1}}) {
    RenderOverrides o = overrides(2, 7, GetParam());
    o.crop = crop;
    const Film part = render_bits(o);
    EXPECT_EQ(part.settings().crop, crop);
    expect_same_bits(part, whole);
  }
}

TEST_P(Bits, HoldForIndependentNumbersToo) {
  RenderOverrides o = overrides(2, 16, GetParam());
  o.sampler = "independent";
  const Film whole = render_bits(o);
  o.crop = PixelBounds{5, 3, 24, 20};
  o.threads = 1;
  expect_same_bits(render_bits(o), whole);
}

TEST(BitsOfSeeds, DifferWithTheSeedAndWithTheReplicate) {
  RenderOverrides o = overrides(2, 16, 4);
  const Film a = render_bits(o);
  o.seed = 4;
  const Film b = render_bits(o);
  int same_seed = 0, same_replicate = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      same_seed += a.sums(x, y, 0).direct == b.sums(x, y, 0).direct && a.sums(x, y, 0).direct[0] > 0;
      same_replicate += a.sums(x, y, 0).direct == a.sums(x, y, 3).direct && a.sums(x, y, 0).direct[0] > 0;
    }
  // Pixels that see nothing but the light are the same in all.
  EXPECT_LT(same_seed, kWidth * kHeight / 20);
  EXPECT_LT(same_replicate, kWidth * kHeight / 20);
}

INSTANTIATE_TEST_SUITE_P(Replicates, Bits, testing::Values(1u, 2u, 4u));

}  // namespace
}  // namespace etd
