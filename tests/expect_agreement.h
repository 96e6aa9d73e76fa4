// Expects that two films estimate the same image.
#pragma once

#include "render_helper.h"
#include "verify/compare_films.h"

namespace etd {

// Fails with numbers and images where a test falls below `level`, and where an error of 1 % in the image's R, G or B
// would not have been seen. Returns the tests.
std::vector<FilmTest> expect_agreement(const std::string& name, const Film& a, const Film& b, double level);

}  // namespace etd
