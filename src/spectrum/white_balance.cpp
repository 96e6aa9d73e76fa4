#include "spectrum/white_balance.h"

#include <algorithm>

#include "spectrum/colorimetry.h"

namespace etd {
namespace {

Vec3d xyz_of(double x, double y) { return {x / y, 1.0, (1.0 - x - y) / y}; }

// The locus of daylight, from 4000 to 25000 K (CIE 15:2004, section 3.1).
Vec3d daylight(double kelvin) {
  const double t = 1000.0 / kelvin;
  const double x = kelvin <= 7000 ? 0.244063 + t * (0.09911 + t * (2.9678 - t * 4.6070))
                                  : 0.237040 + t * (0.24748 + t * (1.9018 - t * 2.0064));
  return xyz_of(x, -3.000 * x * x + 2.870 * x - 0.275);
}

Vec3d black_body(double kelvin) {
  const Chromaticity c = chromaticity([kelvin](double nm) { return blackbody(kelvin, nm); });
  return xyz_of(c.x, c.y);
}

}  // namespace

Vec3d white_of_temperature(double kelvin) {
  constexpr double kBlackBodyTo = 4000, kDaylightFrom = 5000;
  if (kelvin <= kBlackBodyTo) return black_body(kelvin);
  const double share = std::min((kelvin - kBlackBodyTo) / (kDaylightFrom - kBlackBodyTo), 1.0);
  return black_body(kelvin) * (1.0 - share) + daylight(kelvin) * share;
}

}  // namespace etd
