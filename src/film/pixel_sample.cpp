#include "film/pixel_sample.h"

namespace etd {

double PixelSums::add(const PixelSample& s) {
  std::array<double, 4> radiance;
  for (size_t i = 0; i < 3; ++i) {
    const int lane = static_cast<int>(i);
    const double e = s.weight * s.emission[lane], d = s.weight * s.direct[lane], n = s.weight * s.indirect[lane];
    emission[i] += e;
    direct[i] += d;
    indirect[i] += n;
    albedo[i] += s.albedo[lane];
    normal[i] += s.normal[lane];
    radiance[i] = e + d + n;
  }
  radiance[3] = luminance(radiance[0], radiance[1], radiance[2]);
  for (size_t i = 0; i < 4; ++i) squares[i] += radiance[i] * radiance[i];
  depth += s.depth;
  coverage += s.coverage;
  count += 1;
  rays += static_cast<double>(s.rays.total());
  return radiance[3];
}

PixelSums& PixelSums::operator+=(const PixelSums& b) {
  for (size_t i = 0; i < 3; ++i) {
    emission[i] += b.emission[i];
    direct[i] += b.direct[i];
    indirect[i] += b.indirect[i];
    albedo[i] += b.albedo[i];
    normal[i] += b.normal[i];
  }
  for (size_t i = 0; i < 4; ++i) squares[i] += b.squares[i];
  depth += b.depth;
  coverage += b.coverage;
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
