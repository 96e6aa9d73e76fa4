// How wide to search for photons at first, found from a few of them and from what the camera sees.
#pragma once

#include <vector>

#include "core/vec.h"

namespace etd {

struct SeenPoint {
  Point3 p;            // where a path from the camera would gather photons
  double pixel_width;  // of the image's pixels there, across the ray
};

// The radius within which so many photons are found on average, kPhotonsWanted, around half of the photons that are
// seen: a caustic on a dark table decides, not the table. It is at least half of a pixel wide, and no wider than 0.7
// times the distance to the eighth of the given photons, since beyond that bias would not go with the square of the
// radius. `more`: how many photons there will be for each of those given. 0 where nothing is seen.
double first_photon_radius(const std::vector<Point3>& photons, const std::vector<SeenPoint>& seen, double more);

}  // namespace etd
