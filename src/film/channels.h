// The order in which a pixel's sums lie in the film's memory: the one place that knows it. Features come last, so that
// a film without them simply stops earlier.
#pragma once

#include "film/film.h"

namespace etd {

inline constexpr size_t kRadianceChannels = 15;  // emission, direct, indirect, squares, count, rays
inline constexpr size_t kFeatureChannels = 8;    // albedo, normal, depth, coverage
inline constexpr size_t kPositionChannels = 3;

inline size_t film_channels(const FilmSettings& s) {
  return kRadianceChannels + (s.features ? kFeatureChannels + (s.positions ? kPositionChannels : 0) : 0);
}

// Calls f with a reference to every sum, in the order of memory.
template <class Sums, class F>
void for_each_channel(Sums& s, const FilmSettings& kept, F&& f) {
  for (auto& v : s.emission) f(v);
  for (auto& v : s.direct) f(v);
  for (auto& v : s.indirect) f(v);
  for (auto& v : s.squares) f(v);
  f(s.count);
  f(s.rays);
  if (!kept.features) return;
  for (auto& v : s.albedo) f(v);
  for (auto& v : s.normal) f(v);
  f(s.depth);
  f(s.coverage);
  if (!kept.positions) return;
  for (auto& v : s.position) f(v);
}

}  // namespace etd
