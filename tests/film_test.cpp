#include "film/film.h"

#include <gtest/gtest.h>

#include "core/hash.h"

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
  // A replicate that has nothing yet leaves fewer than four, whose spread says too little.
  EXPECT_EQ(film_of({{1}, {2}, {3}, {}}).standard_error(0, 0)[0], HUGE_VAL);
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

TEST(Film, AFullHdPictureOf32ReplicatesFitsIn6Gigabytes) {
  const FilmSettings settings{.width = 1920, .height = 1080, .crop = {0, 0, 1920, 1080}, .replicates = 32};
  EXPECT_LT(Film::bytes_for(settings), size_t{6000000000});
}

// A sample of the replicate, different from all others.
PixelSample feature_sample(uint32_t replicate, uint32_t index) {
  HashStream numbers(hash_combine(replicate, index));
  PixelSample s;
  s.albedo = Spectrum::rgb(numbers.next_float(), numbers.next_float(), numbers.next_float());
  s.normal = {numbers.next_float(), -numbers.next_float(), 0.3f};
  s.depth = 1e4f * numbers.next_float(), s.coverage = 1;
  s.alpha = 1, s.emission = Spectrum(numbers.next_float());
  s.position = {-1e3f * numbers.next_float(), 0.1f, 0.2f};
  s.weight = numbers.next_float() - 0.1f;
  return s;
}

PixelSums feature_sums(uint32_t replicate, uint32_t begin, uint32_t end) {
  PixelSums sums;
  for (uint32_t i = begin; i < end; ++i) sums.add(feature_sample(replicate, i));
  return sums;
}

TEST(Film, FeaturesAreThoseOfTwoHalvesInWhateverOrderTheyCome) {
  FilmSettings settings{.width = 1, .height = 1, .crop = {0, 0, 1, 1}, .replicates = 6};
  settings.positions = settings.alpha = true;
  Film film(settings), backwards(settings);
  for (uint32_t r = 0; r < 6; ++r)
    for (uint32_t pass = 0; pass < 3; ++pass) {
      film.add(0, 0, r, feature_sums(r, 5 * pass, 5 * pass + 5));
      backwards.add(0, 0, 5 - r, feature_sums(5 - r, 5 * (2 - pass), 5 * (2 - pass) + 5));
    }
  // The odd replicates in a film of their own: replicates 1 to 5, without the even ones.
  settings.first_replicate = 1, settings.replicates = 5, settings.of_replicates = 6;
  Film part(settings);
  for (const uint32_t r : {5u, 1u, 3u})
    for (uint32_t pass = 0; pass < 3; ++pass) part.add(0, 0, r - 1, feature_sums(r, 5 * pass, 5 * pass + 5));
  for (const uint32_t parity : {0u, 1u}) {
    PixelSums expected;
    for (uint32_t r = parity; r < 6; r += 2) expected += feature_sums(r, 0, 15);
    for (const Film* f : {&film, &backwards}) {
      const PixelSums half = f->half(0, 0, parity);
      EXPECT_EQ(half.count, 45.0);
      for (size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(half.albedo[i], expected.albedo[i], 1e-8);
        EXPECT_NEAR(half.albedo_squares[i], expected.albedo_squares[i], 1e-8);
        EXPECT_NEAR(half.normal[i], expected.normal[i], 1e-8);
        EXPECT_NEAR(half.normal_squares[i], expected.normal_squares[i], 1e-8);
        EXPECT_NEAR(half.position[i], expected.position[i], 1e-8);
        EXPECT_NEAR(half.surface_emission[i], expected.surface_emission[i], 1e-8);
      }
      EXPECT_NEAR(half.depth, expected.depth, 1e-8);
      EXPECT_NEAR(half.depth_squares, expected.depth_squares, 1e-4);
      EXPECT_NEAR(half.coverage, expected.coverage, 1e-8);
      EXPECT_NEAR(half.coverage_squares, expected.coverage_squares, 1e-8);
      EXPECT_NEAR(half.alpha, expected.alpha, 1e-8);
      // The very same bits.
      EXPECT_EQ(half.depth_squares, film.half(0, 0, parity).depth_squares);
      EXPECT_EQ(half.albedo, film.half(0, 0, parity).albedo);
    }
  }
  EXPECT_EQ(part.half(0, 0, 1).depth, film.half(0, 0, 1).depth);
  EXPECT_EQ(part.half(0, 0, 1).normal_squares, film.half(0, 0, 1).normal_squares);
  EXPECT_EQ(part.half(0, 0, 0).coverage, 0.0);
}

TEST(Film, FeaturesBeyondAllRangesStayAtItsEnd) {
  Film film({.width = 1, .height = 1, .crop = {0, 0, 1, 1}, .replicates = 1});
  PixelSums sums;
  sums.depth_squares = 1e38, sums.albedo[0] = 1e30, sums.count = 1;
  for (int i = 0; i < 3; ++i) film.add(0, 0, 0, sums);
  EXPECT_GT(film.total(0, 0).depth_squares, 1e23);
  EXPECT_GT(film.total(0, 0).albedo[0], 1e9);
}

TEST(Film, FeaturesCanBeLeftOut) {
  FilmSettings settings{.width = 4, .height = 4, .crop = {0, 0, 4, 4}, .replicates = 3};
  // Light, count and squares of each replicate, rays, and of each half 14 words of shares and 4 of depth.
  EXPECT_EQ(Film(settings).bytes(), 16u * ((3u * 14u + 1u + 2u * 18u) * 8u + sizeof(StrongestSample)));
  settings.replicates = 32;  // their spread makes squares superfluous
  EXPECT_EQ(Film(settings).bytes(), 16u * ((32u * 10u + 1u + 2u * 18u) * 8u + sizeof(StrongestSample)));
  settings.features = false;
  settings.replicates = 3;
  Film film(settings);
  EXPECT_EQ(film.bytes(), 16u * ((3u * 14u + 1u) * 8u + sizeof(StrongestSample)));
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
