// Intersection, points and area of quadrics. The intersection is solved in double: a quadric is one primitive among
// thousands of box tests, so this costs little and takes every question of cancellation away.
#include "shapes/quadric.h"

#include "core/warp.h"

namespace etd {
namespace {

using Kind = QuadricPart::Kind;

constexpr double kEdgeDistance = 0x1p-20;

Vec3d as_vector(Point3d p) { return p - Point3d{}; }

// Angle around z in [0, 2 pi).
template <class T>
T azimuth(T x, T y) {
  const T phi = std::atan2(y, x);
  return phi < 0 ? phi + static_cast<T>(2 * M_PI) : phi;
}

// Whether a point of the whole unit shape belongs to the part, or lies no further from it than rounding may take it.
bool is_inside(const Quadric& quadric, Vec3d q) {
  const QuadricPart& part = quadric.part;
  if (part.is_full_sphere()) return true;
  const double slack = quadric.unit_error(q);
  const double r = std::sqrt(q.x * q.x + q.y * q.y), along = part.kind == Kind::kDisk ? r : q.z;
  if (!(along >= part.lo - slack && along <= part.hi + slack)) return false;
  if (part.is_full_circle()) return true;
  const double phi = azimuth(q.x, q.y), beyond = 2 * M_PI - phi;
  return std::min(phi - part.phi_max, beyond) * r <= slack;
}

// Makes the box around the part under the map with these columns: the half extent along an axis is the norm of that row
// of the map, over the columns that are round.
Bounds3 box_around(const QuadricPart& part, Vec3d x, Vec3d y, Vec3d z, Vec3d t) {
  const bool sphere = part.kind == Kind::kSphere, cylinder = part.kind == Kind::kCylinder;
  const double lo = cylinder ? part.lo : 0.0, hi = cylinder ? part.hi : 0.0;
  Bounds3 box;
  for (const double end : {lo, hi}) {
    const Vec3d c = t + z * end;
    const auto half = [&](double a, double b, double d) { return std::sqrt(a * a + b * b + (sphere ? d * d : 0.0)); };
    const Vec3d h{half(x.x, y.x, z.x), half(x.y, y.y, z.y), half(x.z, y.z, z.z)};
    box.extend(Point3d{c.x + h.x, c.y + h.y, c.z + h.z});
    box.extend(Point3d{c.x - h.x, c.y - h.y, c.z - h.z});
  }
  return box;
}

// Keeps q away from the edges of the part: by a share of the shape, or of the distance from the anchor where that is
// much less.
Vec3d away_from_edges(const Quadric& quadric, Vec3d q) {
  const QuadricPart& part = quadric.part;
  const double share = kEdgeDistance * std::min(1.0, 64 * max_component(abs(q - quadric.anchor)));
  const double wanted = std::max(share, 4 * quadric.unit_error(q));
  const auto keep = [wanted](double x, double lo, double hi, bool at_lo, bool at_hi) {
    const double inset = std::min(wanted, 0.125 * (hi - lo));
    if (at_lo) x = std::max(x, lo + inset);
    return at_hi ? std::min(x, hi - inset) : x;
  };
  const double lo = double{part.lo}, hi = double{part.hi}, phi_max = double{part.phi_max};
  double r = std::sqrt(q.x * q.x + q.y * q.y);
  double scale = 1;
  if (part.kind == Kind::kDisk) {
    const double kept = keep(r, lo, hi, part.lo > 0, true);
    scale = r > 0 ? kept / r : 1.0;
    r = kept;
  } else if (part.kind == Kind::kCylinder) {
    q.z = keep(q.z, lo, hi, true, true);
  } else {
    const double z = keep(q.z, lo, hi, part.lo > -1, part.hi < 1);
    const double kept = std::sqrt(std::max(0.0, (1 - z) * (1 + z)));
    if (z != q.z && r > 0) scale = kept / r, q.z = z;
  }
  if (scale != 1) q.x *= scale, q.y *= scale;
  if (part.is_full_circle() || !(r > 0)) return q;
  // A point beyond the first edge has an angle just under a full turn.
  double phi = azimuth(q.x, q.y);
  if (phi > phi_max && 2 * M_PI - phi < phi - phi_max) phi = 0;
  const double kept = keep(phi, 0, phi_max, true, true);
  return kept == phi ? q : Vec3d{r * std::cos(kept), r * std::sin(kept), q.z};
}

// Returns the area of a whole ellipsoid.
double ellipsoid_area(const Affine3d& m) {
  // Semi-axes a >= b >= c are the singular values of the linear part: eigenvalues of its Gram matrix G by the
  // trigonometric solution (Smith 1961), c from the determinant, which keeps it exact for flat ellipsoids.
  const Vec3d x = m.x, y = m.y, z = m.z;
  const double mean = (dot(x, x) + dot(y, y) + dot(z, z)) / 3.0;
  const double gx = dot(x, x) - mean, gy = dot(y, y) - mean, gz = dot(z, z) - mean;
  const double xy = dot(x, y), xz = dot(x, z), yz = dot(y, z);
  const double spread = std::sqrt((gx * gx + gy * gy + gz * gz + 2.0 * (xy * xy + xz * xz + yz * yz)) / 6.0);
  if (spread < 1e-6 * mean) return 4.0 * M_PI * mean;
  const double det = gx * (gy * gz - yz * yz) - xy * (xy * gz - yz * xz) + xz * (xy * yz - gy * xz);
  const double angle = std::acos(std::min(1.0, std::max(-1.0, det / (2.0 * spread * spread * spread)))) / 3.0;
  const double a2 = mean + 2.0 * spread * std::cos(angle),
               c2 = mean + 2.0 * spread * std::cos(angle + 2.0 * M_PI / 3.0);
  const double a = std::sqrt(a2), b = std::sqrt(std::max(0.0, 3.0 * mean - a2 - c2));
  const double c = std::abs(determinant(m)) / (a * b);
  // Legendre's closed form: 2 pi c^2 + (2 pi a b / sin phi) (E(phi,k) sin^2 phi + F(phi,k) cos^2 phi) with
  // cos phi = c/a, k^2 = a^2 (b^2 - c^2) / (b^2 (a^2 - c^2)).
  const double cos_phi = std::min(1.0, c / a), phi = std::acos(cos_phi), sin_phi = std::sin(phi);
  const double k2 = (a * a) * (b * b - c * c) / ((b * b) * (a * a - c * c));
  const double k = std::sqrt(std::min(1.0, std::max(0.0, k2)));
  const double sum = std::ellint_2(k, phi) * sin_phi * sin_phi + std::ellint_1(k, phi) * cos_phi * cos_phi;
  return 2.0 * M_PI * (c * c + a * b * sum / sin_phi);
}

}  // namespace

float QuadricPart::area() const {
  return kind == Kind::kDisk ? 0.5f * phi_max * (hi - lo) * (hi + lo) : phi_max * (hi - lo);
}

// The inverse is taken of the composed map: that of a long chain of transforms need not belong to their product.
Quadric::Quadric(const Transform& unit_to_world, bool flip, const QuadricPart& which)
    : to_world(unit_to_world.matrix()),
      to_object(Transform(unit_to_world.matrix()).inverse_matrix()),
      flip_ng(flip),
      part(which) {
  anchor = on_unit_shape(to_object.t);
  if (part.kind == Kind::kDisk) {
    const double r = length(anchor);
    if (r > double{part.hi}) anchor = anchor * (double{part.hi} / r);
  }
  if (part.kind == Kind::kCylinder) anchor.z = std::min(std::max(anchor.z, double{part.lo}), double{part.hi});
  if (!is_finite(anchor)) anchor = {};
  // Rounding moves p by u |p|, u = 2^-24, which is u |M^-1| |p| in unit coordinates, and |p| is at most what it is at
  // the anchor and |M| |q - anchor|. Factor 4.
  const Affine3d &m = to_world, &inverse = to_object;
  const auto magnitude = [](const Affine3d& a, Vec3d v) { return abs(a.x) * v.x + abs(a.y) * v.y + abs(a.z) * v.z; };
  const Vec3d p = as_vector(m.point({anchor.x, anchor.y, anchor.z}));
  anchor_error_ = 0x1p-22 * max_component(magnitude(inverse, abs(p))) + 0x1p-50;
  error_slope_ = 0x1p-22 * max_component(magnitude(inverse, magnitude(m, {1, 1, 1})));
}

Vec3d Quadric::on_unit_shape(Vec3d q) const {
  if (part.kind == Kind::kDisk) return {q.x, q.y, 0};
  if (part.kind == Kind::kSphere) return normalize(q);
  const double scale = 1.0 / std::sqrt(q.x * q.x + q.y * q.y);
  return {q.x * scale, q.y * scale, q.z};
}

std::optional<Quadric::Intersection> Quadric::intersect(Point3 o, Vec3 d, float t_max, float t_min) const {
  const Vec3d oo = as_vector(to_object.point(to_double(o)));
  const Vec3d dd = to_object.vector(to_double(d));
  if (part.kind == Kind::kDisk) {
    const double t = -oo.z / dd.z;
    const float rounded = static_cast<float>(t);
    if (!(rounded > t_min && rounded < t_max)) return {};  // also when dd.z is 0
    const Vec3d q{oo.x + t * dd.x, oo.y + t * dd.y, 0};
    if (!is_inside(*this, q)) return {};
    return Intersection{rounded, to_float(q - anchor)};
  }
  // Across the axis of a cylinder the problem is that of a circle.
  const double k = part.kind == Kind::kCylinder ? 0.0 : 1.0;
  const auto dot_across = [k](Vec3d a, Vec3d b) { return a.x * b.x + a.y * b.y + k * a.z * b.z; };
  const double a = dot_across(dd, dd);
  if (!(a > 0.0)) return {};
  // The discriminant from the point of the line nearest to the centre, and the root that would cancel from the product
  // of the roots (Haines, Guenther and Akenine-Moeller 2019, "Precision Improvements for Ray/Sphere Intersection").
  const double b = -dot_across(oo, dd);
  const Vec3d nearest = oo + dd * (b / a);
  const double h2 = 1.0 - dot_across(nearest, nearest);
  if (!(h2 >= 0.0)) return {};
  const double c = dot_across(oo, oo) - 1.0;
  const double root = b + std::copysign(std::sqrt(a * h2), b);
  const double t_far_from_zero = root / a, t_other = root != 0.0 ? c / root : 0.0;
  const double roots[2] = {std::min(t_far_from_zero, t_other), std::max(t_far_from_zero, t_other)};
  for (int i = 0; i < 2; ++i) {
    const float t = static_cast<float>(roots[i]);
    if (!(t > t_min && t < t_max)) continue;
    Vec3d q = nearest + dd * (std::sqrt(h2 / a) * (i == 0 ? -1.0 : 1.0));
    const double scale = 1.0 / std::sqrt(dot_across(q, q));
    q = {q.x * scale, q.y * scale, k == 0.0 ? q.z : q.z * scale};
    if (is_inside(*this, q)) return Intersection{t, to_float(q - anchor)};
  }
  return {};
}

Vec3d Quadric::unit_point(Point3 p) const { return on_unit_shape(as_vector(to_object.point(to_double(p)))); }

Bounds3 Quadric::bounds() const { return box_around(part, to_world.x, to_world.y, to_world.z, to_world.t); }

Bounds3 quadric_bounds(const QuadricPart& part, const Transform& unit_to_space) {
  const auto& m = unit_to_space.matrix().m;
  const auto column = [&m](size_t i) { return Vec3d{m[0][i], m[1][i], m[2][i]}; };
  return box_around(part, column(0), column(1), column(2), column(3));
}

SurfacePoint quadric_point(const Quadric& quadric, Vec3d hit) {
  const QuadricPart& part = quadric.part;
  const Vec3d at = part.is_full_sphere() ? hit : away_from_edges(quadric, hit);
  SurfacePoint s;
  s.p = quadric.point(at);
  s.ng = s.ns = quadric.normal(at);

  // Rounding p moves it by u |n|.|p| along the unit normal n, u = 2^-24; factor 2. The distance off the surface is
  // measured by a function of the unit shape, |q| - 1 for a sphere, whose gradient in the world has length |M^-T n|. Of
  // its errors in double only those count that do not shrink with p: a few 2^-53, for which 2^-48 stands.
  const Vec3d gradient = quadric.to_object.transposed(quadric.unit_normal(at));
  s.p_error = 0x1p-23f * dot(abs(s.ng), abs(s.p - Point3{})) + static_cast<float>(0x1p-48 / length(gradient));

  const Vec3 q = to_float(at);
  const float r = std::sqrt(q.x * q.x + q.y * q.y);
  Vec3 dqdv;  // on the unit shape
  s.uv.x = std::min(azimuth(q.x, q.y) / part.phi_max, 1.0f);
  if (part.kind == Kind::kSphere) {
    // theta from its tangent: acos(z) would lose half the digits near the poles.
    const float theta = std::atan2(r, q.z);
    const float theta_lo = part.lo > -1 ? std::acos(part.lo) : kPi, theta_hi = part.hi < 1 ? std::acos(part.hi) : 0.0f;
    s.uv.y = (theta_lo - theta) / (theta_lo - theta_hi);
    if (r > 0.0f) dqdv = Vec3{-q.z * q.x / r, -q.z * q.y / r, r} * (theta_lo - theta_hi);
  } else if (part.kind == Kind::kCylinder) {
    s.uv.y = (q.z - part.lo) / (part.hi - part.lo);
    dqdv.z = part.hi - part.lo;
  } else {
    s.uv.y = (part.hi - r) / (part.hi - part.lo);
    if (r > 0.0f) dqdv = Vec3{-q.x / r, -q.y / r, 0.0f} * (part.hi - part.lo);
  }
  s.dpdu = to_float(quadric.to_world.vector(to_double(Vec3{-part.phi_max * q.y, part.phi_max * q.x, 0.0f})));
  s.dpdv = to_float(quadric.to_world.vector(to_double(dqdv)));
  return s;
}

float quadric_area_stretch(const Quadric& quadric, Vec3d q) {
  return area_stretch(quadric.to_world, quadric.to_object, quadric.unit_normal(q));
}

float quadric_pdf_area(const Quadric& quadric, Vec3d q) {
  return 1.0f / (quadric.part.area() * quadric_area_stretch(quadric, q));
}

float quadric_area(const Quadric& quadric) {
  const QuadricPart& part = quadric.part;
  if (part.is_full_sphere()) return static_cast<float>(ellipsoid_area(quadric.to_world));
  // Midpoint rule: the stretch is smooth, and the same everywhere under a similarity.
  constexpr int kAround = 256;
  const int along = part.kind == Kind::kSphere ? 64 : 1;
  double sum = 0;
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < kAround; ++j) {
      const float z = part.lo + (part.hi - part.lo) * (static_cast<float>(i) + 0.5f) / static_cast<float>(along);
      const float phi = part.phi_max * (static_cast<float>(j) + 0.5f) / kAround;
      const float r = part.kind == Kind::kSphere ? std::sqrt((1 - z) * (1 + z)) : 1.0f;
      sum +=
          static_cast<double>(quadric_area_stretch(quadric, to_double(Vec3{r * std::cos(phi), r * std::sin(phi), z})));
    }
  return static_cast<float>(part.area() * sum / (along * kAround));
}

SurfacePoint sample_quadric(const Quadric& quadric, Vec2 u, Vec3d* q) {
  const QuadricPart& part = quadric.part;
  if (part.is_full_sphere()) {
    *q = normalize(to_double(sample_sphere_uniform(u)));
    return quadric_point(quadric, *q);
  }
  const double phi = double{part.phi_max} * double{u.y};
  const auto between = [&](double lo, double hi) { return lo + (hi - lo) * double{u.x}; };
  const double lo = double{part.lo}, hi = double{part.hi};
  const double z = part.kind == Kind::kDisk ? 0.0 : between(lo, hi);
  const double r = part.kind == Kind::kDisk     ? std::sqrt(between(lo * lo, hi * hi))
                   : part.kind == Kind::kSphere ? std::sqrt(std::max(0.0, (1 - z) * (1 + z)))
                                                : 1.0;
  *q = {r * std::cos(phi), r * std::sin(phi), z};
  return quadric_point(quadric, *q);
}

}  // namespace etd
