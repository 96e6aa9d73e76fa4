// The order in which a pixel's sums lie in the film's memory: the one place that knows it.
#pragma once

#include "film/film.h"

namespace etd {

inline constexpr size_t kRadianceChannels = 15;  // emission, direct, indirect, squares, count, rays
inline constexpr size_t kFeatureChannels = 8;    // albedo, normal, depth, coverage
inline constexpr size_t kPositionChannels = 3;
inline constexpr size_t kAlphaChannels = 4;  // emission of surfaces, alpha

inline size_t film_channels(const FilmSettings& s) {
  return kRadianceChannels + (s.features ? kFeatureChannels + (s.positions ? kPositionChannels : 0) : 0) +
         (s.alpha ? kAlphaChannels : 0);
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
  if (kept.features) {
    for (auto& v : s.albedo) f(v);
    for (auto& v : s.normal) f(v);
    f(s.depth);
    f(s.coverage);
    if (kept.positions)
      for (auto& v : s.position) f(v);
  }
  if (!kept.alpha) return;
  for (auto& v : s.surface_emission) f(v);
  f(s.alpha);
}

}  // namespace etd
