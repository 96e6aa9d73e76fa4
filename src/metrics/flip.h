// FLIP: how large the difference between two pictures looks to somebody who flips between them, in [0, 1] for each
// pixel. For screens: Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom and Fairchild 2020, "FLIP: A Difference
// Evaluator for Alternating Images"; for pictures of any range: Andersson, Nilsson, Shirley and Akenine-Moller 2021,
// "Visualizing Errors in Rendered High Dynamic Range Images".
#pragma once

#include "metrics/plane.h"

namespace etd {

// The papers' viewer: 0.7 m away from a monitor that is 0.7 m and 3840 pixels wide, about 67 pixels per degree.
double flip_default_pixels_per_degree();

// LDR-FLIP of linear Rec.709, values clamped to [0, 1]: what a screen shows without further mapping.
Plane ldr_flip(const Picture& test, const Picture& reference, double pixels_per_degree);

// The range of exposures, in stops, at which the reference's brightest luminance and its median come out at 85 % of
// white, and the number of steps. A range of zero for a black reference.
struct FlipExposures {
  double start = 0, stop = 0;
  int count = 2;
};
FlipExposures flip_exposures(const Picture& reference);

// HDR-FLIP: in each pixel the largest LDR-FLIP over the exposures, mapped to the screen by a fit of the ACES curve
// (Narkowicz 2015, with the scale 0.6). Negative values count as 0.
Plane hdr_flip(const Picture& test, const Picture& reference, const FlipExposures& exposures, double pixels_per_degree);

// The mean of a map: FLIP as one number.
double mean(const Plane& map);

}  // namespace etd
