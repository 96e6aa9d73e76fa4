#include <algorithm>
#include <cmath>

#include "metrics/flip.h"

namespace etd {
namespace {

// The screen's value of a scene value x >= 0: (a x^2 + b x) / (c x^2 + d x + e).
struct AcesFit {
  static constexpr double kScale = 0.6;
  static constexpr double a = 2.51 * kScale * kScale, b = 0.03 * kScale, c = 2.43 * kScale * kScale, d = 0.59 * kScale,
                          e = 0.14;

  static double apply(double x) { return std::min((a * x * x + b * x) / (c * x * x + d * x + e), 1.0); }
  // The x that gives y.
  static double invert(double y) {
    const double p = a - y * c, q = b - y * d, s = -y * e;
    return (-q + std::sqrt(q * q - 4 * p * s)) / (2 * p);
  }
};

constexpr double kTarget = 0.85;  // 2021, section 4.1

Picture on_screen(const Picture& picture, double exposure) {
  constexpr double kBrightest = 1e9;  // whose square is still far from overflow, and white at any exposure that counts
  const double scale = std::exp2(exposure);
  Picture result = picture;
  for (float& v : result.rgb) v = v > 0 ? static_cast<float>(AcesFit::apply(std::min(v * scale, kBrightest))) : 0.0f;
  return result;
}

}  // namespace

FlipExposures flip_exposures(const Picture& reference) {
  Plane luminances = luminance_plane(reference);
  std::vector<float>& y = luminances.values;
  if (y.empty()) return {};
  const float largest = *std::max_element(y.begin(), y.end());
  if (!(largest > 0)) return {};
  const auto middle = y.begin() + static_cast<std::ptrdiff_t>(y.size() / 2);
  std::nth_element(y.begin(), middle, y.end());
  // A picture that is black in more than half of its pixels has no exposure that shows its median.
  const double median = std::max<double>(*middle, 1e-5 * largest);
  FlipExposures exposures;
  exposures.start = std::log2(AcesFit::invert(kTarget) / largest);
  exposures.stop = std::log2(AcesFit::invert(kTarget) / median);
  exposures.count = std::max(2, static_cast<int>(std::ceil(exposures.stop - exposures.start)));
  return exposures;
}

Plane hdr_flip(const Picture& test, const Picture& reference, const FlipExposures& exposures,
               double pixels_per_degree) {
  Plane worst(test.width, test.height);
  for (int i = 0; i < exposures.count; ++i) {
    const double step = exposures.count > 1 ? static_cast<double>(i) / (exposures.count - 1) : 0.0;
    const double exposure = exposures.start + step * (exposures.stop - exposures.start);
    const Plane map = ldr_flip(on_screen(test, exposure), on_screen(reference, exposure), pixels_per_degree);
    std::transform(map.values.begin(), map.values.end(), worst.values.begin(), worst.values.begin(),
                   [](float a, float b) { return std::max(a, b); });
  }
  return worst;
}

}  // namespace etd
