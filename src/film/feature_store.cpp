#include "film/feature_store.h"

#include <cmath>
#include <cstring>

#include "film/film.h"

namespace etd {

namespace {

__extension__ typedef __int128 Int128;

// How a sum is kept: an integer of this type, in units of 2^-kBits.
template <class T, int kBits>
struct Fixed {
  using Integer = T;
  static constexpr size_t kWords = sizeof(T) / sizeof(uint64_t);
  static constexpr T kLargest = static_cast<T>((T{1} << (8 * sizeof(T) - 2)) - 1 + (T{1} << (8 * sizeof(T) - 2)));

  static constexpr double kUnits =
      static_cast<double>(uint64_t{1} << (kBits / 2)) * static_cast<double>(uint64_t{1} << (kBits - kBits / 2));

  static T encode(double v) {
    const double scaled = v * kUnits, limit = static_cast<double>(kLargest);
    if (!(scaled < limit)) return kLargest;
    if (!(scaled > -limit)) return -kLargest;
    return static_cast<T>(std::nearbyint(scaled));
  }
  static double decode(T v) { return static_cast<double>(v) * (1.0 / kUnits); }
  static T add(T a, T b) {
    T sum;
    if (__builtin_add_overflow(a, b, &sum)) return b > 0 ? kLargest : -kLargest;
    return sum;
  }
};
using Share = Fixed<int64_t, 32>;  // of values about as large as 1, whose sum over 2^30 samples has room
using Length = Fixed<Int128, 48>;  // of metres and their squares
using Light = Fixed<Int128, 64>;

// Calls f(sum, how it is kept) for everything that is kept, in the order of memory.
template <class Sums, class F>
void for_each_feature(Sums& s, bool features, bool positions, bool alpha, F&& f) {
  if (features) {
    for (auto& v : s.albedo) f(v, Share());
    for (auto& v : s.normal) f(v, Share());
    f(s.coverage, Share());
    f(s.depth, Length());
    for (auto& v : s.albedo_squares) f(v, Share());
    for (auto& v : s.normal_squares) f(v, Share());
    f(s.coverage_squares, Share());
    f(s.depth_squares, Length());
    if (positions)
      for (auto& v : s.position) f(v, Length());
  }
  if (!alpha) return;
  for (auto& v : s.surface_emission) f(v, Light());
  f(s.alpha, Share());
}

size_t words_of(const FilmSettings& s) {
  size_t words = 0;
  PixelSums sums;
  for_each_feature(sums, s.features, s.positions, s.alpha,
                   [&words](double&, auto kept) { words += decltype(kept)::kWords; });
  return words;
}

}  // namespace

FeatureStore::FeatureStore(size_t pixels, const FilmSettings& s)
    : features_(s.features),
      positions_(s.positions),
      alpha_(s.alpha),
      words_(words_of(s)),
      store_(pixels * 2 * words_, 0) {}

void FeatureStore::add(size_t pixel, uint32_t half, const PixelSums& sums) {
  uint64_t* to = store_.data() + (2 * pixel + half) * words_;
  for_each_feature(sums, features_, positions_, alpha_, [&to](double v, auto kept) {
    using Kept = decltype(kept);
    typename Kept::Integer sum;
    std::memcpy(&sum, to, sizeof sum);
    sum = Kept::add(sum, Kept::encode(v));
    std::memcpy(to, &sum, sizeof sum);
    to += Kept::kWords;
  });
}

void FeatureStore::add_to(size_t pixel, uint32_t half, PixelSums& sums) const {
  const uint64_t* from = store_.data() + (2 * pixel + half) * words_;
  for_each_feature(sums, features_, positions_, alpha_, [&from](double& v, auto kept) {
    using Kept = decltype(kept);
    typename Kept::Integer sum;
    std::memcpy(&sum, from, sizeof sum);
    v += Kept::decode(sum);
    from += Kept::kWords;
  });
}

size_t FeatureStore::bytes_for(size_t pixels, const FilmSettings& s) {
  return pixels * 2 * words_of(s) * sizeof(uint64_t);
}

}  // namespace etd
