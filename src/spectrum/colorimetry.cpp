#include "spectrum/colorimetry.h"

#include "spectrum/cie_data.h"
#include "spectrum/color_space.h"

namespace etd {

namespace {

// The luminance that the lanes have together, in double.
double luminance_of(const Vec3d& rgb) { return luminance(rgb.x, rgb.y, rgb.z); }

Spectrum to_spectrum(const Vec3d& rgb) {
  return Spectrum::rgb(static_cast<float>(rgb.x), static_cast<float>(rgb.y), static_cast<float>(rgb.z));
}

}  // namespace

double interpolate(std::span<const double> nm, std::span<const double> values, double at, bool extend) {
  if (nm.empty()) return 0.0;
  if (at < nm.front()) return extend ? values.front() : 0.0;
  if (at > nm.back()) return extend ? values.back() : 0.0;
  const auto above = std::upper_bound(nm.begin(), nm.end(), at);
  if (above == nm.end()) return values.back();
  const auto i = static_cast<size_t>(above - nm.begin());
  const double t = (at - nm[i - 1]) / (nm[i] - nm[i - 1]);
  return values[i - 1] * (1.0 - t) + values[i] * t;
}

double blackbody(double kelvin, double nm) {
  // L ~ x^5 / (e^x - 1) with x = h c / (lambda k T), which is greatest at x = 4.965114 (Wien's displacement law).
  constexpr double kSecondConstant = 1.438776877e7;  // h c / k in nm K
  const auto radiance = [](double x) { return x * x * x * x * x / std::expm1(x); };
  return radiance(kSecondConstant / (nm * kelvin)) / radiance(4.965114231744276);
}

Vec3d cie_xyz(const SpectralFunction& f) {
  Vec3d sum;
  for (double nm = kVisibleFirst; nm <= kVisibleLast; nm += 1.0) {
    const double value = f(nm) * (nm == kVisibleFirst || nm == kVisibleLast ? 0.5 : 1.0);
    sum += Vec3d{visible_value(kCieX, nm), visible_value(kCieY, nm), visible_value(kCieZ, nm)} * value;
  }
  return sum;
}

Chromaticity chromaticity(const SpectralFunction& f) {
  const Vec3d xyz = cie_xyz(f);
  const double sum = xyz.x + xyz.y + xyz.z;
  return {xyz.x / sum, xyz.y / sum};
}

Spectrum emission_rgb(const SpectralFunction& f) {
  Vec3d rgb = xyz_to_rec709(cie_xyz(f));
  for (int i = 0; i < 3; ++i) rgb[i] = std::max(rgb[i], 0.0);
  const double y = luminance_of(rgb);
  return y > 0.0 ? to_spectrum(rgb * (1.0 / y)) : Spectrum();
}

Spectrum reflectance_rgb(const SpectralFunction& f) {
  static const Vec3d white = xyz_to_rec709(cie_xyz(d65));
  const Vec3d rgb = xyz_to_rec709(cie_xyz([&](double nm) { return f(nm) * d65(nm); }));
  return max(to_spectrum({rgb.x / white.x, rgb.y / white.y, rgb.z / white.z}), 0.0f);
}

double d65(double nm) {
  static const VisibleTable& table = [&]() -> const VisibleTable& {
    for (const Illuminant& i : illuminants())
      if (i.name == "stdillum-D65") return i.power;
    return illuminants()[0].power;
  }();
  return visible_value(table, nm);
}

}  // namespace etd
