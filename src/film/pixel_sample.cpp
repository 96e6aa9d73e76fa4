#include "film/pixel_sample.h"

namespace etd {

double PixelSums::add(const PixelSample& s) {
  const double w = s.weight;
  std::array<double, 4> radiance;
  for (size_t i = 0; i < 3; ++i) {
    const int lane = static_cast<int>(i);
    const double e = w * s.emission[lane], d = w * s.direct[lane], n = w * s.indirect[lane];
    emission[i] += e;
    if (s.alpha > 0) surface_emission[i] += e;
    direct[i] += d;
    indirect[i] += n;
    albedo[i] += w * s.albedo[lane];
    normal[i] += w * s.normal[lane];
    position[i] += w * s.position[lane];
    radiance[i] = e + d + n;
  }
  radiance[3] = luminance(radiance[0], radiance[1], radiance[2]);
  for (size_t i = 0; i < 4; ++i) squares[i] += radiance[i] * radiance[i];
  depth += w * s.depth;
  coverage += w * s.coverage;
  alpha += w * s.alpha;
  count += 1;
  rays += static_cast<double>(s.rays.total());
  return radiance[3];
}

PixelSums& PixelSums::operator+=(const PixelSums& b) {
  for (size_t i = 0; i < 3; ++i) {
    emission[i] += b.emission[i];
    surface_emission[i] += b.surface_emission[i];
    direct[i] += b.direct[i];
    indirect[i] += b.indirect[i];
    albedo[i] += b.albedo[i];
    normal[i] += b.normal[i];
    position[i] += b.position[i];
  }
  for (size_t i = 0; i < 4; ++i) squares[i] += b.squares[i];
  depth += b.depth;
  coverage += b.coverage;
  alpha += b.alpha;
  count += b.count;
  rays += b.rays;
  return *this;
}

std::array<double, 3> PixelSums::mean(const std::array<double, 3>& sum) const {
  if (count == 0) return {};
  return {sum[0] / count, sum[1] / count, sum[2] / count};
}

std::array<double, 4> PixelSums::mean_radiance() const {
  std::array<double, 3> total;
  for (size_t i = 0; i < 3; ++i) total[i] = emission[i] + direct[i] + indirect[i];
  const std::array<double, 3> m = mean(total);
  return {m[0], m[1], m[2], luminance(m[0], m[1], m[2])};
}

}  // namespace etd
