#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/math.h"
#include "metrics/flip.h"
#include "spectrum/color_space.h"

namespace etd {
namespace {

using std::numbers::pi;

// A filter of contrast sensitivity (2020, eq. 3 and table 1): a sum of Gaussians a sqrt(pi / b) exp(-pi^2 x^2 / b) with
// x in degrees.
struct Sensitivity {
  double a1, b1, a2, b2;
};
constexpr Sensitivity kAchromatic{1, 0.0047, 0, 1e-5}, kRedGreen{1, 0.0053, 0, 1e-5},
    kBlueYellow{34.1, 0.04, 13.5, 0.025};
constexpr double kWidest = 0.04;         // of the b: all three filters have the size that it needs
constexpr double kFeatureWidth = 0.082;  // degrees, of the detector of edges and points (2020, section 4.2)
// Section 4.1.3: errors of colour below kKnee of the largest one take up to kKneeValue of the scale.
constexpr double kColorExponent = 0.7, kKnee = 0.4, kKneeValue = 0.95;
constexpr double kFeatureExponent = 0.5;

// L*, a*, b* or Y, Cx, Cz.
using Planes = std::array<Plane, 3>;

Vec3d white() {
  static const Vec3d w = rec709_to_xyz({1, 1, 1});
  return w;
}

// CIE XYZ relative to the white.
Vec3d relative_xyz(const Vec3d& rgb) {
  const Vec3d xyz = rec709_to_xyz(rgb), w = white();
  return {xyz.x / w.x, xyz.y / w.y, xyz.z / w.z};
}
// The linearised opponent space YyCxCz, and back to linear Rec.709.
Vec3d to_opponent(const Vec3d& rgb) {
  const Vec3d v = relative_xyz(rgb);
  return {116 * v.y - 16, 500 * (v.x - v.y), 200 * (v.y - v.z)};
}
Vec3d from_opponent(const Vec3d& c) {
  const double y = (c.x + 16) / 116;
  const Vec3d w = white();
  return xyz_to_rec709({(y + c.y / 500) * w.x, y * w.y, (y - c.z / 200) * w.z});
}

// CIE L*a*b* with chroma weighed by lightness (Hunt's effect; 2020, eq. 4).
Vec3d hunt_lab(const Vec3d& rgb) {
  constexpr double kDelta = 6.0 / 29.0;
  const auto f = [](double t) {
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29.0;
  };
  const Vec3d v = relative_xyz(rgb);
  const double lightness = 116 * f(v.y) - 16;
  return {lightness, 0.01 * lightness * 500 * (f(v.x) - f(v.y)), 0.01 * lightness * 200 * (f(v.y) - f(v.z))};
}

// Distance in that space (Abasi, Amani Tehran and Fairchild 2020).
double hyab(const Vec3d& a, const Vec3d& b) { return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

Planes opponent_planes(const Picture& picture) {
  Planes planes;
  planes.fill(Plane(picture.width, picture.height));
  for (size_t i = 0; i < picture.pixels(); ++i) {
    const float* p = &picture.rgb[3 * i];
    const auto shown = [](float v) { return v > 0 ? std::min<double>(v, 1) : 0.0; };
    const Vec3d c = to_opponent({shown(p[0]), shown(p[1]), shown(p[2])});
    for (int k = 0; k < 3; ++k) planes[static_cast<size_t>(k)].values[i] = static_cast<float>(c[k]);
  }
  return planes;
}

// Each of the two Gaussians is separable; of both together the weights add up to 1.
Plane blur(const Plane& plane, const Sensitivity& s, double pixels_per_degree) {
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(kWidest / (2 * pi * pi)) * pixels_per_degree));
  const auto sigma = [&](double b) { return std::sqrt(b / (2 * pi * pi)) * pixels_per_degree; };
  const auto weight = [&](double a, double b) {  // of the Gaussian's samples in the plane
    double sum = 0;
    for (int x = -radius; x <= radius; ++x) sum += std::exp(-x * x / (2 * sqr(sigma(b))));
    return a * std::sqrt(pi / b) * sum * sum;
  };
  const auto gaussian = [&](double b) {
    const Kernel kernel = gaussian_kernel(sigma(b), radius);
    return convolve(plane, kernel, kernel);
  };
  Plane result = gaussian(s.b1);
  if (s.a2 == 0) return result;
  const Plane second = gaussian(s.b2);
  const double w1 = weight(s.a1, s.b1), w2 = weight(s.a2, s.b2);
  const float share = static_cast<float>(w2 / (w1 + w2));
  for (size_t i = 0; i < result.values.size(); ++i)
    result.values[i] = (1 - share) * result.values[i] + share * second.values[i];
  return result;
}

// What the eye resolves of a picture's colours.
Planes perceived_lab(const Planes& opponent, double pixels_per_degree) {
  Planes planes = {blur(opponent[0], kAchromatic, pixels_per_degree), blur(opponent[1], kRedGreen, pixels_per_degree),
                   blur(opponent[2], kBlueYellow, pixels_per_degree)};
  for (size_t i = 0; i < planes[0].values.size(); ++i) {
    Vec3d rgb = from_opponent({planes[0].values[i], planes[1].values[i], planes[2].values[i]});
    for (int c = 0; c < 3; ++c) rgb[c] = std::clamp(rgb[c], 0.0, 1.0);
    const Vec3d lab = hunt_lab(rgb);
    for (int c = 0; c < 3; ++c) planes[static_cast<size_t>(c)].values[i] = static_cast<float>(lab[c]);
  }
  return planes;
}

// The error of colour in [0, 1] (2020, eq. 5 to 7).
double color_error(const Vec3d& a, const Vec3d& b) {
  static const double largest = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), kColorExponent);
  const double error = std::pow(hyab(a, b), kColorExponent), knee = kKnee * largest;
  if (error < knee) return kKneeValue * error / knee;
  return kKneeValue + (1 - kKneeValue) * (error - knee) / (largest - knee);
}

// First and second derivative of a Gaussian, each with positive weights of sum 1 and negative ones of sum -1.
struct Detectors {
  Kernel gaussian, edge, point;
};
Detectors detectors(double pixels_per_degree) {
  const double sigma = 0.5 * kFeatureWidth * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  const auto derivative = [&](auto&& factor) {
    Kernel kernel;
    double positive = 0, negative = 0;
    for (int x = -radius; x <= radius; ++x) {
      const double v = factor(x) * std::exp(-x * x / (2 * sigma * sigma));
      (v > 0 ? positive : negative) += v;
      kernel.push_back(static_cast<float>(v));
    }
    for (float& v : kernel) v /= static_cast<float>(v > 0 ? positive : -negative);
    return kernel;
  };
  return {gaussian_kernel(sigma, radius), derivative([](int x) { return -static_cast<double>(x); }),
          derivative([sigma](int x) { return x * x / (sigma * sigma) - 1; })};
}

// How strong edges (or points) are in each pixel.
Plane strength(const Plane& grey, const Kernel& derivative, const Kernel& gaussian) {
  Plane across = convolve(grey, derivative, gaussian);
  const Plane down = convolve(grey, gaussian, derivative);
  for (size_t i = 0; i < across.values.size(); ++i) across.values[i] = std::hypot(across.values[i], down.values[i]);
  return across;
}

Plane normalised(const Plane& lightness) {
  Plane grey = lightness;
  for (float& v : grey.values) v = (v + 16) / 116;
  return grey;
}

}  // namespace

double flip_default_pixels_per_degree() { return 0.7 * (3840 / 0.7) * pi / 180; }

Plane ldr_flip(const Picture& test, const Picture& reference, double pixels_per_degree) {
  const Planes opponent_t = opponent_planes(test), opponent_r = opponent_planes(reference);
  const Planes t = perceived_lab(opponent_t, pixels_per_degree), r = perceived_lab(opponent_r, pixels_per_degree);
  const Plane grey_t = normalised(opponent_t[0]), grey_r = normalised(opponent_r[0]);
  const Detectors d = detectors(pixels_per_degree);
  const Plane edge_t = strength(grey_t, d.edge, d.gaussian), edge_r = strength(grey_r, d.edge, d.gaussian);
  const Plane point_t = strength(grey_t, d.point, d.gaussian), point_r = strength(grey_r, d.point, d.gaussian);

  Plane map(test.width, test.height);
  for (size_t i = 0; i < map.values.size(); ++i) {
    const double color =
        color_error({t[0].values[i], t[1].values[i], t[2].values[i]}, {r[0].values[i], r[1].values[i], r[2].values[i]});
    const double feature =
        std::max(std::abs(edge_t.values[i] - edge_r.values[i]), std::abs(point_t.values[i] - point_r.values[i]));
    const double feature_error = std::min(std::pow(feature / std::numbers::sqrt2, kFeatureExponent), 1.0);
    map.values[i] = static_cast<float>(std::pow(color, 1 - feature_error));
  }
  return map;
}

double mean(const Plane& map) {
  double sum = 0;
  for (const float v : map.values) sum += v;
  return map.values.empty() ? 0.0 : sum / static_cast<double>(map.values.size());
}

}  // namespace etd
