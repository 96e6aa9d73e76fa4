// What integrators hand over: samples by pixel and replicate, and splats.
#include "film/sink.h"

#include <gtest/gtest.h>

#include <limits>

namespace etd {
namespace {

PixelSample direct(float value) {
  PixelSample s;
  s.direct = Spectrum(value);
  s.rays = {1, 0, 2};
  return s;
}

TEST(Sink, SumsSamplesByReplicateAndRemembersTheStrongest) {
  Film film({.width = 4, .height = 3, .crop = {1, 1, 4, 3}, .replicates = 2});
  Sink sink(film);
  {
    Sink::Pixel pixel(sink, 2, 1);
    pixel.add(0, 0, direct(1)), pixel.add(0, 1, direct(2));
    pixel.add(1, 0, direct(7)), pixel.add(1, 1, direct(4));
  }
  EXPECT_EQ(film.sums(2, 1, 0).direct[1], 3.0);
  EXPECT_EQ(film.sums(2, 1, 1).direct[1], 11.0);
  EXPECT_EQ(film.total(2, 1).count, 4.0);
  EXPECT_EQ(film.total(1, 1).count, 0.0);
  EXPECT_EQ(film.strongest(2, 1).number, 1u);  // index 0 of replicate 1
  EXPECT_EQ(sink.counts().rays.shadow, 8u);
}

TEST(Sink, RefusesAndCountsWhatIsNoLight) {
  Film film({.width = 1, .height = 1, .crop = {0, 0, 1, 1}, .replicates = 4, .splats = true});
  Sink sink(film);
  constexpr float kInfinite = std::numeric_limits<float>::infinity(), kNaN = std::numeric_limits<float>::quiet_NaN();
  Sink::Pixel(sink, 0, 0).add(2, 5, direct(kNaN));
  Sink::Splat(sink, 1, Spectrum(-1.0f), {0, 0, 3}).add(0, 0, 1.0f);
  Sink::Splat(sink, 1, Spectrum(kInfinite), {0, 0, 2}).add(0, 0, 1.0f);
  Sink::Splat(sink, 1, Spectrum(1e30f), {0, 0, 1}).add(0, 0, 1.0f);  // more than the film can sum up
  EXPECT_EQ(sink.counts().invalid.nan, 1u);
  EXPECT_EQ(sink.counts().invalid.negative, 1u);
  EXPECT_EQ(sink.counts().invalid.infinite, 2u);
  EXPECT_EQ(sink.counts().invalid.first->number, 1u);
  film.fold_splats(0, 2, 1, 0);
  EXPECT_EQ(film.total(0, 0).direct[0], 0.0);
}

TEST(Sink, SplatsBecomeMeansOverTheLightPathsOfTheWholeImage) {
  FilmSettings settings{.width = 4, .height = 2, .crop = {1, 0, 3, 2}, .replicates = 4, .splats = true};
  settings.sensor.imaging_ratio = 2;
  Film film(settings);
  Sink sink(film);
  Sink::Splat(sink, 0, Spectrum(3.0f), {1, 1, 0}).add(1, 1, 0.5f);
  Sink::Splat(sink, 1, Spectrum(4.0f), {1, 1, 0}).add(1, 1, -0.25f);
  Sink::Splat(sink, 2, Spectrum(5.0f), {1, 1, 0}).add(1, 1, 1.0f);
  Sink::Splat(sink, 7, Spectrum(6.0f), {1, 1, 0}).add(1, 1, 1.0f);
  Sink::Splat(sink, 0, Spectrum(9.0f), {0, 1, 0}).add(0, 1, 1.0f);  // beside the crop
  Sink::Splat(sink, 0, Spectrum(9.0f), {1, 2, 0}).add(1, 2, 1.0f);
  for (int y = 0; y < 2; ++y) film.fold_splats(y, 1, 24, 80);
  const PixelSums sums = film.sums(1, 1, 1);
  EXPECT_EQ(sums.count, 3.0);  // 24 paths for 4 x 2 pixels
  EXPECT_EQ(film.total(1, 1).rays, 10.0);
  // Twice the light for the exposure, a mean over 24 paths.
  EXPECT_NEAR(sums.mean(sums.emission)[0], 2 * 1.5 / 24, 1e-15);
  EXPECT_NEAR(sums.mean(sums.direct)[1], 2 * -1.0 / 24, 1e-15);
  EXPECT_NEAR(sums.mean(sums.indirect)[2], 2 * 11.0 / 24, 1e-15);
  EXPECT_EQ(film.sums(2, 0, 1).count, 3.0);
  EXPECT_EQ(film.sums(2, 0, 1).emission[0], 0.0);
  EXPECT_EQ(film.sums(1, 1, 0).count, 0.0);
  // They are folded once.
  film.fold_splats(1, 1, 8, 0);
  EXPECT_EQ(film.sums(1, 1, 1).emission, sums.emission);
  EXPECT_EQ(film.sums(1, 1, 1).count, 4.0);
}

}  // namespace
}  // namespace etd
