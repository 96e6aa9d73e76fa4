#include "metrics/ssim.h"

#include "core/math.h"

namespace etd {
namespace {

constexpr int kRadius = 5;
constexpr double kSigma = 1.5;
constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;

Plane product(const Plane& a, const Plane& b) {
  Plane result(a.width, a.height);
  for (size_t i = 0; i < a.values.size(); ++i) result.values[i] = a.values[i] * b.values[i];
  return result;
}

}  // namespace

std::optional<double> ssim(const Plane& x, const Plane& r) {
  if (x.width <= 2 * kRadius || x.height <= 2 * kRadius) return {};
  const Kernel window = gaussian_kernel(kSigma, kRadius);
  const auto blur = [&window](const Plane& p) { return convolve(p, window, window); };
  const Plane mean_x = blur(x), mean_r = blur(r);
  const Plane xx = blur(product(x, x)), rr = blur(product(r, r)), xr = blur(product(x, r));
  double sum = 0;
  for (int j = kRadius; j < x.height - kRadius; ++j)
    for (int i = kRadius; i < x.width - kRadius; ++i) {
      const double mx = mean_x.at(i, j), mr = mean_r.at(i, j);
      const double vx = xx.at(i, j) - mx * mx, vr = rr.at(i, j) - mr * mr, cov = xr.at(i, j) - mx * mr;
      sum += (2 * mx * mr + kC1) * (2 * cov + kC2) / ((mx * mx + mr * mr + kC1) * (vx + vr + kC2));
    }
  return sum / ((x.width - 2.0 * kRadius) * (x.height - 2.0 * kRadius));
}

}  // namespace etd
