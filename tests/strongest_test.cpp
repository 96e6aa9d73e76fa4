// The strongest samples of an image: which they are, and that they do not depend on threads and tiles.
#include "film/strongest.h"

#include <gtest/gtest.h>

#include "film/film.h"
#include "render_helper.h"

namespace etd {
namespace {

void add(Film& film, int x, std::initializer_list<float> luminances) {
  PixelSums sums;
  StrongestSample strongest;
  uint32_t number = 0;
  for (const float v : luminances) {
    PixelSample s;
    s.direct = Spectrum(v);
    strongest.offer({static_cast<float>(sums.add(s)), number++});
  }
  film.add(x, 0, 0, sums);
  film.offer(x, 0, strongest);
}

TEST(StrongestSamples, FirefliesStandBeforeBrightNeighbours) {
  Film film({.width = 5, .height = 1, .crop = {0, 0, 5, 1}, .replicates = 1});
  add(film, 0, {100, 100, 100, 100});  // a lamp
  add(film, 1, {1, 60, 1, 1});         // a firefly
  add(film, 2, {0, 0, 0, 0});
  add(film, 3, {2, 2, 2, 3});
  const std::vector<SampleStrength> all = strongest_samples(film, 10);
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].id, (SampleId{1, 0, 1}));
  EXPECT_EQ(all[1].id, (SampleId{0, 0, 0}));
  EXPECT_EQ(all[2].id, (SampleId{3, 0, 3}));
  EXPECT_FLOAT_EQ(all[0].luminance, 60);
  EXPECT_NEAR(all[0].share, 60.0 / 63, 1e-6);
  EXPECT_NEAR(all[0].strength, 60 * 60.0 / 63, 1e-4);
  EXPECT_NEAR(all[1].strength, 25, 1e-4);
  ASSERT_EQ(strongest_samples(film, 1).size(), 1u);
  EXPECT_EQ(strongest_samples(film, 1)[0].id, all[0].id);
  EXPECT_TRUE(strongest_samples(film, 0).empty());
}

TEST(StrongestSamples, TheOrderOfOffersDoesNotMatter) {
  StrongestSample a, b;
  const std::vector<StrongestSample> all = {{1, 4}, {-3, 9}, {3, 7}, {3, 11}, {0, 2}};
  for (size_t i = 0; i < all.size(); ++i) a.offer(all[i]), b.offer(all[all.size() - 1 - i]);
  EXPECT_EQ(a.number, 7u);
  EXPECT_EQ(b.number, 7u);
}

TEST(StrongestSamples, AreTheSameForAnyThreadsAndTiles) {
  RenderOverrides o;
  o.size = {40, 30};
  o.spp = 32;
  o.threads = 1;
  const auto file = source_path("tests/scenes/agree/glass_caustic.pbrt");
  const std::vector<SampleStrength> one = strongest_samples(render_scene(file, o), 64);
  ASSERT_EQ(one.size(), 64u);
  for (size_t i = 1; i < one.size(); ++i) EXPECT_GE(one[i - 1].strength, one[i].strength);
  for (const int tile : {16, 5, 64}) {
    o.threads = 4, o.tile_size = tile;
    const std::vector<SampleStrength> many = strongest_samples(render_scene(file, o), 64);
    ASSERT_EQ(many.size(), 64u);
    for (size_t i = 0; i < 64; ++i) {
      EXPECT_EQ(many[i].id, one[i].id);
      EXPECT_EQ(many[i].luminance, one[i].luminance);
      EXPECT_EQ(many[i].share, one[i].share);
    }
  }
}

}  // namespace
}  // namespace etd
