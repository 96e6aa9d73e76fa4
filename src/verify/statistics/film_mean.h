// Means over regions of a film, one for each replicate.
//
// The replicates of a film are independent renders, so the mean of anything over a region is, from replicate to
// replicate, a sample of independent numbers of the same normal distribution (each is a mean over very many paths):
// what t-tests ask for, whatever the sampler does within a replicate and however pixels differ.
#pragma once

#include <optional>
#include <string>

#include "core/bounds.h"
#include "film/film.h"
#include "verify/statistics/statistics.h"

namespace etd {

// A part of the light, in one channel or as the mean of R, G and B.
struct Quantity {
  enum class Component { kBeauty, kEmission, kDirect, kIndirect };
  Component component = Component::kBeauty;
  std::optional<int> channel;
};
// "beauty", "direct.G" and the like; nothing for any other text.
std::optional<Quantity> parse_quantity(const std::string& text);

// The mean over the samples of `sums`.
double value(const PixelSums& sums, const Quantity& quantity);

// Takes for each replicate the mean over pixels of a region (equal weight for each), times `factor`.
RunningStats region_mean(const Film& film, const PixelBounds& region, const Quantity& quantity, double factor = 1.0);
// Takes the mean over all pixels of the film.
RunningStats image_mean(const Film& film, const Quantity& quantity = {});

// How many samples carry the light of a region; few when it rests on rare bright ones: (sum x)^2 / sum x^2, or what the
// spread of four replicates or more tells of that. The mean of N samples whose squares outweigh that of the mean has
// the variance E[x^2] / N.
double effective_samples(const Film& film, const PixelBounds& region);

}  // namespace etd
