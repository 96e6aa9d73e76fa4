#include "core/solid_angle.h"

namespace etd {

namespace {

double clamped(double x, double lo, double hi) { return x < lo ? lo : (x > hi ? hi : x); }
double root(double x) { return std::sqrt(x > 0.0 ? x : 0.0); }

// The unit vector of w's part perpendicular to the unit vector v.
Vec3d perpendicular(Vec3d w, Vec3d v) { return normalize(w - v * dot(w, v)); }

// An angle as a complex number of any length.
struct Turn {
  double cos, sin;
};
Turn operator+(Turn a, Turn b) { return {a.cos * b.cos - a.sin * b.sin, a.sin * b.cos + a.cos * b.sin}; }

}  // namespace

SphericalTriangle::SphericalTriangle(Point3d p, const Point3d (&corners)[3])
    : a_(normalize(corners[0] - p)), b_(normalize(corners[1] - p)), c_(normalize(corners[2] - p)) {
  // tan(solid angle / 2), robust for small triangles (Van Oosterom and Strackee 1983).
  const double volume = std::abs(dot(a_, cross(b_, c_)));
  const double solid_angle = 2.0 * std::atan2(volume, 1.0 + dot(a_, b_) + dot(b_, c_) + dot(c_, a_));
  const Vec3d ab = cross(a_, b_), ac = cross(a_, c_);
  const double lengths = length(ab) * length(ac);
  if (!(lengths > 0.0) || !(solid_angle > 0.0) || !std::isfinite(solid_angle)) return;
  cos_alpha_ = dot(ab, ac) / lengths;
  sin_alpha_ = volume / lengths;  // |(a x b) x (a x c)| = |a . (b x c)|
  if (sin_alpha_ > 0.0) solid_angle_ = solid_angle;
}

Vec3d SphericalTriangle::sample(Vec2 u) const {
  // The corner c moves along the arc from a to c until the triangle has the share u.x of its area.
  const double area = static_cast<double>(u.x) * solid_angle_;
  const double sin_area = std::sin(area), cos_area = std::cos(area);
  const double s = sin_area * cos_alpha_ - cos_area * sin_alpha_;  // sin(area - alpha)
  const double t = cos_area * cos_alpha_ + sin_area * sin_alpha_;  // cos(area - alpha)
  const double x = t - cos_alpha_, y = s + sin_alpha_ * dot(a_, b_);
  const double divisor = (y * s + x * t) * sin_alpha_;
  const double q = divisor != 0.0 ? clamped(((y * t - x * s) * cos_alpha_ - y) / divisor, -1.0, 1.0) : 1.0;
  const Vec3d moved = a_ * q + perpendicular(c_, a_) * root(1.0 - q * q);
  // Then a direction along the arc from b to there.
  const double z = 1.0 - static_cast<double>(u.y) * (1.0 - dot(moved, b_));
  const Vec3d across = moved - b_ * dot(moved, b_);
  const double l = length(across);
  return l > 0.0 ? normalize(b_ * z + across * (root(1.0 - z * z) / l)) : b_;
}

RectangleFrame::RectangleFrame(Point3d at, Vec3d along_x, Vec3d along_y)
    : corner(at), width(length(along_x)), height(length(along_y)) {
  x = along_x * (1.0 / width), y = along_y * (1.0 / height), n = cross(x, y);
}

SphericalRectangle::SphericalRectangle(Point3d p, const RectangleFrame& r) : width_(r.width), height_(r.height) {
  const Vec3d d = r.corner - p;
  x0_ = dot(d, r.x), y0_ = dot(d, r.y);
  x1_ = x0_ + width_, y1_ = y0_ + height_;
  distance_ = std::abs(dot(d, r.n));
  if (!(distance_ > 0.0)) return;
  // The inner angles, whose sum is the solid angle plus 2 pi, are those between the planes through p and two
  // neighbouring edges. With the distance l of their corner (x, y, z), the plane through p and the edge along x has the
  // normal (0, z, -y), and so on: the cosine and the sine of the angle are as x y to z l. Angles are added as complex
  // numbers of any length, with one arc tangent for all. The sum of two is at least 0 and at most 2 pi: the sign of its
  // sine, even of 0, tells on which side of pi it is.
  const double z = distance_, z2 = z * z;
  const auto inner = [z](double xy, double l2) { return Turn{xy, z * std::sqrt(l2)}; };
  const double x02 = x0_ * x0_, x12 = x1_ * x1_, y02 = z2 + y0_ * y0_, y12 = z2 + y1_ * y1_;
  const Turn first = inner(x1_ * y0_, x12 + y02) + inner(-x1_ * y1_, x12 + y12);
  const Turn second = inner(x0_ * y1_, x02 + y12) + inner(-x0_ * y0_, x02 + y02), sum = first + second;
  cos_k_ = second.cos, sin_k_ = -second.sin;
  solid_angle_ = std::atan2(sum.sin, sum.cos);
  if (std::signbit(solid_angle_))
    solid_angle_ = std::signbit(first.sin) && std::signbit(second.sin) ? solid_angle_ + 2.0 * kPiD : 0.0;
}

Vec2T<double> SphericalRectangle::sample(Vec2 u) const {
  // Where the cut through p is that has the share u.x of the solid angle on one side, by Urena's equations with z0 =
  // -distance.
  const double share = static_cast<double>(u.x) * solid_angle_;
  const Turn au = Turn{std::cos(share), std::sin(share)} + Turn{cos_k_, sin_k_};
  const double z2 = distance_ * distance_, b0 = -y0_ / std::sqrt(z2 + y0_ * y0_), b1 = y1_ / std::sqrt(z2 + y1_ * y1_);
  const double fu = (au.cos * b0 - b1 * std::sqrt(cos_k_ * cos_k_ + sin_k_ * sin_k_)) / au.sin;
  // His c_u d / sqrt(1 - c_u^2) with c_u = 1 / sqrt(f_u^2 + b_0^2).
  const double xu = clamped(std::copysign(distance_ / root(fu * fu + b0 * b0 - 1.0), fu), x0_, x1_);
  // Along that cut the solid angle is even in the sine of the elevation.
  const double d2 = xu * xu + z2;
  const double h0 = y0_ / std::sqrt(d2 + y0_ * y0_), h1 = y1_ / std::sqrt(d2 + y1_ * y1_);
  const double h = h0 + static_cast<double>(u.y) * (h1 - h0), h2 = h * h;
  const double yv = h2 < 1.0 - 1e-12 ? clamped(h * std::sqrt(d2 / (1.0 - h2)), y0_, y1_) : y1_;
  return {clamped((xu - x0_) / width_, 0.0, 1.0), clamped((yv - y0_) / height_, 0.0, 1.0)};
}

std::optional<SphericalCap> SphericalCap::seen_from(Point3d p, Point3d center, double radius) {
  const Vec3d d = center - p;
  const double distance = length(d);
  if (!(distance > radius * (1.0 + 1e-4)) || !std::isfinite(distance)) return {};
  return SphericalCap{d * (1.0 / distance), distance, sqr(radius / distance)};
}

double SphericalCap::solid_angle() const { return 2.0 * kPiD * sin2_max / (1.0 + std::sqrt(1.0 - sin2_max)); }

Vec3d SphericalCap::sample_normal(Vec2 u) const {
  // theta is the angle at p between the axis and the direction, alpha that at the centre between the axis and the point
  // met: from the triangle of both and p, cos alpha = sin^2 theta / sin max + cos theta sqrt(1 - sin^2 theta / sin^2
  // max).
  const double above = static_cast<double>(u.x) * sin2_max / (1.0 + std::sqrt(1.0 - sin2_max));  // 1 - cos theta
  const double sin2 = above * (2.0 - above), ratio = std::min(1.0, sin2 / sin2_max);
  const double cos_alpha = clamped(ratio * std::sqrt(sin2_max) + (1.0 - above) * root(1.0 - ratio), -1.0, 1.0);
  const double sin_alpha = root(1.0 - cos_alpha * cos_alpha), phi = 2.0 * kPiD * static_cast<double>(u.y);
  const Vec3d helper = std::abs(axis.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  const Vec3d s = perpendicular(helper, axis), t = cross(axis, s);
  return s * (sin_alpha * std::cos(phi)) + t * (sin_alpha * std::sin(phi)) - axis * cos_alpha;
}

}  // namespace etd
