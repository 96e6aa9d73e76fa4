// How much a single sample of a pixel can bring. An estimator whose mean rests on rare bright samples may have met none
// of them: its own spread does not show that, but the size that such samples can have bounds how likely it is.
#pragma once

#include "scene/scene.h"

namespace etd {

struct SamplePeaks {
  double scattering = 0;  // of estimators that find light by scattering, alone or under MIS
  double light = 0;       // of those that find it by sampling lights, whatever the surface makes of it
};

// Found by following a few paths through the scene; larger than what they met, so as to be on the safe side.
SamplePeaks find_sample_peaks(const Scene& scene, int width, int height);

// An upper bound for the probability that the mean of n samples, which are not negative and at most `peak`, is as low
// as `mean` when their expectation is `expected` > mean: exp(-n (expected - mean)^2 / (2 E[x^2])), E[x^2] <= expected
// peak (the lower tail of Bernstein's inequality for non-negative variables; Boucheron, Lugosi and Massart 2013,
// section 2.7).
double chance_of_low_mean(double mean, double expected, double n, double peak);

}  // namespace etd
