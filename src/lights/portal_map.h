// An environment as it is seen through a rectangular window: for every point, the part of it that can be seen is a
// rectangle in the angles around the window's two edges (Bitterli, Novak and Jarosz 2015, "Portal-Masked Environment
// Map Sampling"), from which directions are sampled in proportion to the radiance.
#pragma once

#include "core/frame.h"
#include "core/windowed_distribution.h"
#include "lights/environment_map.h"

namespace etd {

// A rectangle in the recentred world.
struct Portal {
  Point3 corner;
  Frame frame;  // x and y along the edges from the corner, z to where the light comes from
  float width = 0, height = 0;
};

class PortalMap {
 public:
  // `axes`: of the map, in the world. The map must not move.
  PortalMap(const EnvironmentMap& map, const Frame& axes, const Portal& portal);

  // The map's value in the unit direction w as seen from p: black beside the portal, and everywhere behind it.
  Spectrum value(Point3 p, Vec3 w) const;
  // The map's value in the unit direction w, whatever is in the way.
  Spectrum value(Vec3 w) const { return map_->value(axes_.to_local(w)); }
  // Whether p sees through the portal in the direction w.
  bool is_open(Point3 p, Vec3 w) const;
  // A direction from p through the portal, in proportion to the mean of R, G and B; nothing from behind.
  std::optional<Vec3> sample(Point3 p, Vec2 u) const;
  // Density of sample() at the unit direction w, per solid angle.
  float pdf(Point3 p, Vec3 w) const;
  // The same from a point within the portal, which sees half of all directions.
  std::optional<Vec3> sample(Vec2 u) const { return sample_within(kAll, u); }
  float pdf(Vec3 w) const { return pdf_within(kAll, w); }
  const Portal& portal() const { return portal_; }
  // The flux that comes in through the portal, area times solid angle times the unit of the values.
  Spectrum flux() const { return flux_; }
  size_t bytes() const { return distribution_.bytes(); }

 private:
  using Window = WindowedDistribution::Window;
  using Point = WindowedDistribution::Point;
  static constexpr Window kAll{{0, 0}, {1, 1}};
  std::optional<Window> window(Point3 p) const;
  std::optional<Vec3> sample_within(const Window& window, Vec2 u) const;
  float pdf_within(const Window& window, Vec3 w) const;
  // Angles of the local direction w with w.z > 0 around y and x, from 0 to 1 over half a turn; and back.
  static Point angles(Vec3d w);
  static Vec3d direction(Point at);
  // Solid angle for each area of the square of angles, at the local direction w.
  static double solid_angle_factor(Vec3d w);
  Vec3d to_local(Vec3 w) const;

  const EnvironmentMap* map_;
  Frame axes_;
  Portal portal_;
  WindowedDistribution distribution_;
  Spectrum flux_;
};

}  // namespace etd
