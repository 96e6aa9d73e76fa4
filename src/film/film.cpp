#include "film/film.h"

#include <cassert>

namespace etd {
namespace {

size_t pixel_count(const PixelBounds& crop) {
  return crop.empty() ? 0 : static_cast<size_t>(crop.width()) * static_cast<size_t>(crop.height());
}

// Calls f with a reference to each sum of light, in the order in which a replicate's lie in memory.
template <class Sums, class F>
void for_each_channel(Sums& s, bool squares, F&& f) {
  for (auto& v : s.emission) f(v);
  for (auto& v : s.direct) f(v);
  for (auto& v : s.indirect) f(v);
  f(s.count);
  if (!squares) return;
  for (auto& v : s.squares) f(v);
}

bool keeps_squares(const FilmSettings& s) { return s.replicates < kReplicatesForSpread; }

// Doubles of a replicate.
size_t channels(const FilmSettings& s) {
  size_t count = 0;
  PixelSums sums;
  for_each_channel(sums, keeps_squares(s), [&count](double&) { ++count; });
  return count;
}

// R, G and B of emission, direct and indirect.
constexpr size_t kSplatSlots = 9;

// Var(mean) from the spread of `means` with weights `counts` (sum n): a replicate of n_r samples has variance s^2 /
// n_r, so sum n_r (m_r - m)^2 / (R - 1) estimates s^2 without bias, for equal counts and others alike.
std::array<double, 4> spread_of_replicates(const std::vector<std::array<double, 4>>& means,
                                           const std::vector<double>& counts, const std::array<double, 4>& mean,
                                           double n) {
  std::array<double, 4> variance{};
  for (size_t r = 0; r < means.size(); ++r)
    for (size_t i = 0; i < 4; ++i) variance[i] += counts[r] * sqr(means[r][i] - mean[i]);
  for (double& v : variance) v /= static_cast<double>(means.size() - 1) * n;
  return variance;
}

}  // namespace

Film::Film(const FilmSettings& settings)
    : settings_(settings),
      channels_(channels(settings)),
      sums_(pixel_count(settings.crop) * settings.replicates * channels_, 0.0),
      rays_(pixel_count(settings.crop), 0.0),
      features_(pixel_count(settings.crop), settings),
      strongest_(pixel_count(settings.crop)),
      ids_(settings.ids ? pixel_count(settings.crop) : 0) {
  const PixelBounds& c = settings_.crop;
  if (settings.splats) splats_.emplace(pixel_count(settings.crop) * kSplatSlots);
  assert(settings_.replicates > 0);
  assert(c.empty() || (c.x0 >= 0 && c.y0 >= 0 && c.x1 <= settings_.width && c.y1 <= settings_.height));
  static_cast<void>(c);
}

size_t Film::pixel(int x, int y) const {
  const PixelBounds& c = settings_.crop;
  assert(x >= c.x0 && x < c.x1 && y >= c.y0 && y < c.y1);
  return static_cast<size_t>(y - c.y0) * static_cast<size_t>(c.width()) + static_cast<size_t>(x - c.x0);
}

size_t Film::offset(int x, int y, uint32_t replicate) const {
  assert(replicate < settings_.replicates);
  return (pixel(x, y) * settings_.replicates + replicate) * channels_;
}

void Film::add(int x, int y, uint32_t replicate, const PixelSums& sums) {
  double* to = sums_.data() + offset(x, y, replicate);
  for_each_channel(sums, keeps_squares(settings_), [&to](double v) { *to++ += v; });
  const size_t at = pixel(x, y);
  rays_[at] += sums.rays;
  features_.add(at, (settings_.first_replicate + replicate) % 2, sums);
}

void Film::splat(int x, int y, int depth, const Spectrum& light) {
  const size_t first = pixel(x, y) * kSplatSlots + static_cast<size_t>(std::min(depth, 2)) * 3;
  for (int lane = 0; lane < 3; ++lane)
    if (light[lane] != 0.0f) splats_->add(first + static_cast<size_t>(lane), static_cast<double>(light[lane]));
}

void Film::fold_splats(int y, uint32_t replicate, uint64_t light_paths, uint64_t rays) {
  const double pixels = static_cast<double>(settings_.width) * static_cast<double>(settings_.height);
  for (int x = settings_.crop.x0; x < settings_.crop.x1; ++x) {
    PixelSums sums;
    size_t slot = pixel(x, y) * kSplatSlots;
    for (std::array<double, 3>* part : {&sums.emission, &sums.direct, &sums.indirect})
      for (double& v : *part) v = splats_->take(slot++) / pixels;
    sums.count = static_cast<double>(light_paths) / pixels;
    sums.rays = static_cast<double>(rays) / pixels;
    add(x, y, replicate, sums);
  }
}

PixelSums Film::sums(int x, int y, uint32_t replicate) const {
  PixelSums result;
  const double* from = sums_.data() + offset(x, y, replicate);
  for_each_channel(result, keeps_squares(settings_), [&from](double& v) { v = *from++; });
  return result;
}

PixelSums Film::light(int x, int y) const {
  PixelSums result = sums(x, y, 0);
  for (uint32_t r = 1; r < settings_.replicates; ++r) result += sums(x, y, r);
  return result;
}

PixelSums Film::total(int x, int y) const {
  PixelSums result = light(x, y);
  for (const uint32_t parity : {0u, 1u}) features_.add_to(pixel(x, y), parity, result);
  result.rays = rays_[pixel(x, y)];
  return result;
}

PixelSums Film::half(int x, int y, uint32_t parity) const {
  PixelSums result;
  for (uint32_t r = 0; r < settings_.replicates; ++r)
    if ((settings_.first_replicate + r) % 2 == parity) result += sums(x, y, r);
  features_.add_to(pixel(x, y), parity, result);
  return result;
}

std::array<double, 4> Film::standard_error(int x, int y) const {
  constexpr std::array<double, 4> kUnknown = {HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL};
  const PixelSums all = light(x, y);
  const double n = all.count;
  if (n < 2) return kUnknown;
  const std::array<double, 4> mean = all.mean_radiance();

  std::array<double, 4> variance{};  // of the mean
  if (keeps_squares(settings_)) {
    for (size_t i = 0; i < 4; ++i) variance[i] = (all.squares[i] - n * sqr(mean[i])) / (n * (n - 1));
  } else {
    std::vector<std::array<double, 4>> means;
    std::vector<double> counts;
    for (uint32_t r = 0; r < settings_.replicates; ++r) {
      const PixelSums s = sums(x, y, r);
      if (s.count == 0) continue;
      means.push_back(s.mean_radiance());
      counts.push_back(s.count);
    }
    if (means.size() < kReplicatesForSpread) return kUnknown;
    variance = spread_of_replicates(means, counts, mean, n);
  }
  std::array<double, 4> error;
  for (size_t i = 0; i < 4; ++i) error[i] = std::sqrt(std::max(variance[i], 0.0));
  return error;
}

size_t Film::bytes() const { return bytes_for(settings_); }

size_t Film::bytes_for(const FilmSettings& s) {
  return FeatureStore::bytes_for(pixel_count(s.crop), s) +
         pixel_count(s.crop) * ((s.replicates * channels(s) + 1) * sizeof(double) + sizeof(StrongestSample) +
                                (s.ids ? sizeof(PixelIds) : 0) + (s.splats ? SplatBuffer::bytes_for(kSplatSlots) : 0));
}

}  // namespace etd
