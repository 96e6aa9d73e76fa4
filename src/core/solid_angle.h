// Triangles, rectangles and balls as a point sees them: their solid angle, and directions that are uniform in it. In
// double, because small and grazing ones are differences of large angles.
#pragma once

#include <optional>

#include "core/vec.h"

namespace etd {

// A triangle projected to the unit sphere around a point (Arvo 1995, "Stratified Sampling of Spherical Triangles").
class SphericalTriangle {
 public:
  // Makes the triangle of the corners as seen from p; its solid angle is 0 when p is at a corner or in the triangle's
  // plane.
  SphericalTriangle(Point3d p, const Point3d (&corners)[3]);

  double solid_angle() const { return solid_angle_; }
  // A unit direction; only when the solid angle is positive.
  Vec3d sample(Vec2 u) const;

 private:
  Vec3d a_, b_, c_;                       // unit directions to the corners
  double cos_alpha_ = 1, sin_alpha_ = 0;  // of the angle between the arcs at a
  double solid_angle_ = 0;
};

// A rectangle from `corner` along the perpendicular unit vectors x and y.
struct RectangleFrame {
  Point3d corner;
  Vec3d x, y, n;
  double width = 0, height = 0;

  // `along_x` and `along_y` are its edges.
  RectangleFrame(Point3d at, Vec3d along_x, Vec3d along_y);
};

// A rectangle the same way (Urena, Fajardo and King 2013, "An Area-Preserving Parametrization for Spherical
// Rectangles").
class SphericalRectangle {
 public:
  // Makes the rectangle as seen from p; its solid angle is 0 when p is in its plane.
  SphericalRectangle(Point3d p, const RectangleFrame& rectangle);

  double solid_angle() const { return solid_angle_; }
  // Returns where the sampled direction meets the rectangle, as shares of its edges in [0, 1]; only when the solid
  // angle is positive.
  Vec2T<double> sample(Vec2 u) const;

 private:
  double width_, height_;         // of the rectangle
  double x0_, y0_, x1_, y1_;      // its edges in the frame around p
  double distance_;               // of its plane from p
  double cos_k_ = 1, sin_k_ = 0;  // of Urena's angle k, times anything positive
  double solid_angle_ = 0;
};

// A ball seen from outside: a cone of directions.
struct SphericalCap {
  Vec3d axis;       // unit, to the centre
  double distance;  // of the centre
  double sin2_max;  // squared sine of the cone's half angle

  // Nothing from inside of the ball and from closer than a ten-thousandth of its radius.
  static std::optional<SphericalCap> seen_from(Point3d p, Point3d center, double radius);
  double solid_angle() const;
  // The unit normal of the ball where the sampled direction first meets it.
  Vec3d sample_normal(Vec2 u) const;
};

}  // namespace etd
