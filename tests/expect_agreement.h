// Expects that two films estimate the same image.
#pragma once

#include <functional>
#include <utility>

#include "render_helper.h"
#include "second_run.h"
#include "verify/statistics/compare_films.h"

namespace etd {

// `films` renders both with the seeds and samples of a run. Fails, with numbers and images, where a test falls below
// `level` in both runs, and where the first would not have seen an error of the share `visible` in the image's R, G or
// B. Returns the tests of the last run.
std::vector<FilmTest> expect_agreement(const std::string& name, double level,
                                       const std::function<std::pair<Film, Film>(const TestRun&)>& films,
                                       double visible = 0.01);

}  // namespace etd
