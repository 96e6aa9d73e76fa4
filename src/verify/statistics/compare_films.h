// Whether two films estimate the same image: Welch tests between the means of regions.
#pragma once

#include <string>
#include <vector>

#include "verify/statistics/film_mean.h"

namespace etd {

struct FilmTest {
  std::string what;
  PixelBounds region;
  RunningStats a, b;  // of the replicates
  TestResult result;
};

// Side of the blocks, in pixels.
inline constexpr int kFilmBlock = 8;

// Tests of the whole image (R, G, B, direct and indirect light), then of each block. `planted` is a factor on b, for
// tests of the test. Both films have the same crop.
std::vector<FilmTest> compare_films(const Film& a, const Film& b, double planted = 1.0);
// How many tests that makes.
uint64_t film_test_count(int width, int height);
// How many of the tests, from the first, are R, G and B of the image.
inline constexpr size_t kImageChannelTests = 3;

}  // namespace etd
