#include "film/film.h"

#include <gtest/gtest.h>

namespace etd {
namespace {

PixelSample grey(float value) {
  PixelSample s;
  s.direct = Spectrum::rgb(value, value, value);
  return s;
}

// A one-pixel film whose replicate r received `samples[r]`.
Film film_of(const std::vector<std::vector<float>>& samples) {
  Film film({.width = 1, .height = 1, .crop = {0, 0, 1, 1}, .replicates = static_cast<uint32_t>(samples.size())});
  for (size_t r = 0; r < samples.size(); ++r) {
    PixelSums sums;
    for (float v : samples[r]) sums.add(grey(v));
    film.add(0, 0, static_cast<uint32_t>(r), sums);
  }
  return film;
}

TEST(Film, StandardErrorOfFewReplicatesComesFromTheMoments) {
  // Samples 1, 2, 3, 6: mean 3, sum of squared deviations 4 + 1 + 0 + 9 = 14, so se^2 = 14 / (3 * 4).
  const double expected = std::sqrt(14.0 / 12.0);
  for (const Film& film : {film_of({{1, 2, 3, 6}}), film_of({{1, 2}, {3, 6}}), film_of({{1}, {2, 6}, {3}})})
    for (double e : film.standard_error(0, 0)) EXPECT_NEAR(e, expected, 1e-14);
}

TEST(Film, StandardErrorOfFourReplicatesComesFromTheirSpread) {
  // Replicate means 1, 2, 3, 6 with two samples each; what happens inside a replicate does not matter.
  const Film film = film_of({{0, 2}, {2, 2}, {1, 5}, {6, 6}});
  for (double e : film.standard_error(0, 0)) EXPECT_NEAR(e, std::sqrt(14.0 / 3.0 / 4.0), 1e-14);
}

TEST(Film, StandardErrorOfEightReplicates) {
  // Means 1 ... 8: variance of the eight is 6.
  const Film film = film_of({{1}, {2}, {3}, {4}, {5}, {6}, {7}, {8}});
  for (double e : film.standard_error(0, 0)) EXPECT_NEAR(e, std::sqrt(6.0 / 8.0), 1e-14);
}

TEST(Film, ReplicatesOfDifferentSizeAreWeightedByTheirSamples) {
  // Means 0 (3 samples), 2, 2, 2 (1 each): mean 1, sum n_r (m_r - m)^2 = 6, R - 1 = 3, n = 6.
  const Film film = film_of({{0, 0, 0}, {2}, {2}, {2}});
  EXPECT_NEAR(film.standard_error(0, 0)[0], std::sqrt(6.0 / (3.0 * 6.0)), 1e-14);
  // A replicate that has nothing yet leaves fewer than four: the moments of 1, 2, 3 decide.
  EXPECT_NEAR(film_of({{1}, {2}, {3}, {}}).standard_error(0, 0)[0], std::sqrt(2.0 / (2.0 * 3.0)), 1e-14);
}

TEST(Film, OneSampleHasInfiniteError) {
  for (const Film& film : {film_of({{1}}), film_of({{}, {1}}), film_of({{1}, {}, {}, {}, {}}), film_of({{}})})
    for (double e : film.standard_error(0, 0)) EXPECT_EQ(e, HUGE_VAL);
  EXPECT_EQ(film_of({{}}).total(0, 0).mean_radiance()[0], 0.0);
}

TEST(Film, ErrorIsOfTheSumOfTheComponentsPerChannelAndLuminance) {
  Film film({.width = 1, .height = 1, .crop = {0, 0, 1, 1}, .replicates = 1});
  PixelSums sums;
  for (float v : {0.0f, 2.0f}) {
    PixelSample s;
    s.emission = Spectrum::rgb(v, 0, 0);
    s.direct = Spectrum::rgb(0, v, 0);
    s.indirect = Spectrum::rgb(1 + v, -v, 0);
    sums.add(s);
  }
  film.add(0, 0, 0, sums);
  // R: 1, 5 (se 2); G: 0, 0; B: 0, 0; Y: 0.2126 R.
  const std::array<double, 4> e = film.standard_error(0, 0);
  EXPECT_NEAR(e[0], 2.0, 1e-14);
  EXPECT_EQ(e[1], 0.0);
  EXPECT_EQ(e[2], 0.0);
  EXPECT_NEAR(e[3], 2.0 * 0.2126, 1e-14);
  EXPECT_NEAR(film.total(0, 0).mean_radiance()[3], 3.0 * 0.2126, 1e-14);
}

TEST(Film, EverySumIsKeptPerReplicateAndFolded) {
  Film film({.width = 8, .height = 6, .crop = {2, 1, 5, 4}, .replicates = 2});
  PixelSample s;
  s.emission = Spectrum::rgb(1, 2, 3);
  s.direct = Spectrum::rgb(4, 5, 6);
  s.indirect = Spectrum::rgb(7, 8, 9);
  s.albedo = Spectrum::rgb(0.1f, 0.2f, 0.3f);
  s.normal = {0, 0, 1};
  s.depth = 5, s.coverage = 1;
  s.rays = {1, 2, 3};
  PixelSums one;
  one.add(s);
  film.add(4, 3, 1, one);
  film.add(4, 3, 1, one);
  film.add(4, 3, 0, one);
  EXPECT_EQ(film.sums(4, 3, 1).count, 2.0);
  EXPECT_EQ(film.sums(4, 3, 0).count, 1.0);
  const PixelSums all = film.total(4, 3);
  EXPECT_EQ(all.emission, (std::array<double, 3>{3, 6, 9}));
  EXPECT_EQ(all.mean(all.indirect), (std::array<double, 3>{7, 8, 9}));
  EXPECT_EQ(all.normal[2], 3.0);
  EXPECT_EQ(all.depth, 15.0);
  EXPECT_EQ(all.coverage, 3.0);
  EXPECT_EQ(all.rays, 18.0);
  EXPECT_EQ(all.squares[0], 3.0 * 144.0);
  EXPECT_EQ(film.total(3, 3).count, 0.0);
  EXPECT_EQ(film.total(2, 1).count, 0.0);
}

TEST(Film, FeaturesCanBeLeftOut) {
  FilmSettings settings{.width = 4, .height = 4, .crop = {0, 0, 4, 4}, .replicates = 3};
  EXPECT_EQ(Film(settings).bytes(), 16u * (3u * 23u * sizeof(double) + sizeof(StrongestSample)));
  settings.features = false;
  Film film(settings);
  EXPECT_EQ(film.bytes(), 16u * (3u * 15u * sizeof(double) + sizeof(StrongestSample)));
  EXPECT_EQ(film.bytes(), Film::bytes_for(settings));
  PixelSample s = grey(2);
  s.depth = 7;
  PixelSums sums;
  sums.add(s);
  film.add(3, 3, 2, sums);
  EXPECT_EQ(film.total(3, 3).direct[1], 2.0);
  EXPECT_EQ(film.total(3, 3).count, 1.0);
  EXPECT_EQ(film.total(3, 3).depth, 0.0);
}

}  // namespace
}  // namespace etd
