// Takes the bias off films whose light was gathered within a radius.
#pragma once

#include "film/film.h"

namespace etd {

// Returns what a film would be with a radius of 0, of one with a radius and one with its half: (4 half - whole) / 3 for
// each pixel and replicate, since the bias goes with the square (Richardson 1911).
Film extrapolate_to_no_radius(const Film& whole, const Film& half);

}  // namespace etd
