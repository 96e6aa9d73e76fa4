// Whether two films estimate the same image: Welch tests between the means of regions.
#pragma once

#include <string>
#include <vector>

#include "render_helper.h"

namespace etd {

struct FilmTest {
  std::string what;
  RunningStats a, b;  // of the replicates
  TestResult result;
};

// Tests of the whole image (R, G, B, direct and indirect light), then of each block of 8 x 8 pixels. `planted` is a
// factor on b, for tests of the test.
std::vector<FilmTest> compare_films(const Film& a, const Film& b, double planted = 1.0);
// How many tests that makes.
uint64_t film_test_count(int width, int height);

// Whether no test falls below `level`.
bool films_agree(const Film& a, const Film& b, double level);

// Fails with numbers and images where a test falls below `level`, and where an error of 1 % in the image's R, G or B
// would not have been seen.
void expect_agreement(const std::string& name, const Film& a, const Film& b, double level);

}  // namespace etd
