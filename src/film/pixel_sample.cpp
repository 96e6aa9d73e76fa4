#include "film/pixel_sample.h"

namespace etd {

namespace {

void add_feature(double v, double& sum, double& squares) {
  sum += v;
  squares += v * v;
}

}  // namespace

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
    add_feature(w * s.albedo[lane], albedo[i], albedo_squares[i]);
    add_feature(w * s.normal[lane], normal[i], normal_squares[i]);
    position[i] += w * s.position[lane];
    radiance[i] = e + d + n;
  }
  radiance[3] = luminance(radiance[0], radiance[1], radiance[2]);
  for (size_t i = 0; i < 4; ++i) squares[i] += radiance[i] * radiance[i];
  add_feature(w * s.depth, depth, depth_squares);
  add_feature(w * s.coverage, coverage, coverage_squares);
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
    albedo_squares[i] += b.albedo_squares[i];
    normal_squares[i] += b.normal_squares[i];
  }
  for (size_t i = 0; i < 4; ++i) squares[i] += b.squares[i];
  depth += b.depth;
  coverage += b.coverage;
  depth_squares += b.depth_squares;
  coverage_squares += b.coverage_squares;
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
