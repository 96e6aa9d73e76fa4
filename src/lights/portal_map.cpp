#include "lights/portal_map.h"

namespace etd {

namespace {}

PortalMap::Point PortalMap::angles(Vec3d w) {
  return {std::atan2(w.x, w.z) / kPiD + 0.5, std::atan2(w.y, w.z) / kPiD + 0.5};
}

Vec3d PortalMap::direction(Point at) {
  return normalize(Vec3d{std::tan((at.x - 0.5) * kPiD), std::tan((at.y - 0.5) * kPiD), 1.0});
}

double PortalMap::solid_angle_factor(Vec3d w) { return sqr(kPiD) * (1.0 - w.x * w.x) * (1.0 - w.y * w.y) / w.z; }

Vec3d PortalMap::to_local(Vec3 w) const {
  const Vec3d d = to_double(w);
  return {dot(d, to_double(portal_.frame.x)), dot(d, to_double(portal_.frame.y)), dot(d, to_double(portal_.frame.z))};
}

PortalMap::PortalMap(const EnvironmentMap& map, const Frame& axes, const Portal& portal)
    : map_(&map), axes_(axes), portal_(portal) {
  // Cells about as fine as the map's texels, each the mean of a few directions.
  const int n = std::clamp(map.height(), 16, 1024), parts = std::max(3, 512 / n);
  std::vector<double> values, factors;
  double mean = 0, flux[3] = {0, 0, 0};
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      double value = 0, factor = 0;
      for (int part = 0; part < parts * parts; ++part) {
        const double px = (part % parts + 0.5) / parts, py = (part / parts + 0.5) / parts;
        const Vec3d local = direction({(x + px) / n, (y + py) / n});
        const Spectrum v = map.value(normalize(axes.to_local(portal.frame.to_world(to_float(local)))));
        const double f = solid_angle_factor(local) / (parts * parts);
        for (int c = 0; c < 3; ++c) flux[c] += static_cast<double>(v[c]) * f * local.z;
        value += static_cast<double>(mean_value(v)) * f;
        factor += f;
      }
      values.push_back(value);
      factors.push_back(factor);
      mean += value;
    }
  // What the few directions may have missed is found by a little of everything.
  const double floor = mean > 0.0 ? 1e-3 * mean / (2.0 * kPiD * n * n) : 1.0;
  for (size_t i = 0; i < values.size(); ++i) values[i] += floor * factors[i];
  distribution_ = WindowedDistribution(n, n, values);
  const double area = static_cast<double>(portal.width) * portal.height / (static_cast<double>(n) * n);
  flux_ = Spectrum::rgb(static_cast<float>(flux[0] * area), static_cast<float>(flux[1] * area),
                        static_cast<float>(flux[2] * area));
}

std::optional<PortalMap::Window> PortalMap::window(Point3 p) const {
  const Vec3d corner = to_local(portal_.corner - p);
  if (!(corner.z > 0.0)) return {};
  return Window{angles(corner), angles({corner.x + portal_.width, corner.y + portal_.height, corner.z})};
}

bool PortalMap::is_open(Point3 p, Vec3 w) const {
  const Vec3d local = to_local(w);
  const auto seen = window(p);
  return seen && local.z > 0.0 && seen->contains(angles(local));
}

Spectrum PortalMap::value(Point3 p, Vec3 w) const { return is_open(p, w) ? value(w) : Spectrum(); }

std::optional<Vec3> PortalMap::sample(Point3 p, Vec2 u) const {
  const auto seen = window(p);
  return seen ? sample_within(*seen, u) : std::nullopt;
}

float PortalMap::pdf(Point3 p, Vec3 w) const {
  const auto seen = window(p);
  return seen ? pdf_within(*seen, w) : 0.0f;
}

std::optional<Vec3> PortalMap::sample_within(const Window& window, Vec2 u) const {
  if (!(distribution_.integral(window) > 0.0)) return {};
  return normalize(portal_.frame.to_world(to_float(direction(distribution_.sample(u, window)))));
}

float PortalMap::pdf_within(const Window& window, Vec3 w) const {
  const Vec3d local = to_local(w);
  if (!(local.z > 0.0)) return 0.0f;
  return static_cast<float>(distribution_.pdf(angles(local), window) / solid_angle_factor(local));
}

}  // namespace etd
