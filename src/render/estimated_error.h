// How noisy an image is, as one number: what the progress bar shows and --error compares with.
#pragma once

#include "film/film.h"
#include "render/workers.h"

namespace etd {

// The relative standard error of the image, from luminances Y of mean Ybar:
//   sqrt(mean over pixels of se^2 / (Y^2 + 0.01 Ybar^2)).
// 0 for a black image, +inf where some pixel has fewer than two samples. The same bits for any number of threads.
double estimated_error(const Film& film, Workers& workers);
// Works on a number of threads as in DriverSettings.
double estimated_error(const Film& film, int threads = 0);

}  // namespace etd
