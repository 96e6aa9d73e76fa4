// Intersection, points and area of quadrics. The intersection is solved in double: a quadric is one primitive among
// thousands of box tests, so this costs little and takes every question of cancellation away.
#include "shapes/quadric.h"

#include "core/warp.h"

namespace etd {
namespace {

using Kind = QuadricPart::Kind;

constexpr float kEdgeDistance = 0x1p-20f;

Vec3d vector_in_double(const Affine& a, Vec3d v) {
  return to_double(a.x) * v.x + to_double(a.y) * v.y + to_double(a.z) * v.z;
}
Vec3d point_in_double(const Affine& a, Vec3d p) { return to_double(a.t) + vector_in_double(a, p); }
Vec3d as_vector(Point3 p) { return {p.x, p.y, p.z}; }

// Angle around z in [0, 2 pi).
template <class T>
T azimuth(T x, T y) {
  const T phi = std::atan2(y, x);
  return phi < 0 ? phi + static_cast<T>(2 * M_PI) : phi;
}

// Whether a point of the whole unit shape belongs to the part, or lies within `slack` of it.
bool is_inside(const QuadricPart& part, double slack, Vec3d q) {
  if (part.is_full_sphere()) return true;
  const double r = std::sqrt(q.x * q.x + q.y * q.y), along = part.kind == Kind::kDisk ? r : q.z;
  if (!(along >= part.lo - slack && along <= part.hi + slack)) return false;
  if (part.is_full_circle()) return true;
  const double phi = azimuth(q.x, q.y), beyond = 2 * M_PI - phi;
  return std::min(phi - part.phi_max, beyond) * r <= slack;
}

// Around the part under the map with these columns: the half extent along an axis is the norm of that row of the map,
// over the columns that are round.
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

// How far rounding may take a point of the surface from where it should be, in unit coordinates: with u = 2^-24,
// u |M^-1| |p| from rounding p, u |M^-1| (|p| + |t|) from the entries of M, the same from those of the inverse.
// Factor 4.
float unit_error(const Quadric& quadric, Point3 p) {
  const Affine& m = quadric.to_object;
  const Vec3 size = abs(p - Point3{}) + abs(quadric.to_world.t);
  const Vec3 error = abs(m.x) * size.x + abs(m.y) * size.y + abs(m.z) * size.z;
  return 0x1p-22f * (std::max(error.x, std::max(error.y, error.z)) + 1.0f);
}

// Keeps q away from the edges of the part.
Vec3 away_from_edges(const QuadricPart& part, float error, Vec3 q) {
  if (part.is_full_sphere()) return q;
  const auto keep = [error](float x, float lo, float hi, bool at_lo, bool at_hi) {
    const float inset = std::min(std::max(kEdgeDistance, 4 * error), 0.125f * (hi - lo));
    if (at_lo) x = std::max(x, lo + inset);
    return at_hi ? std::min(x, hi - inset) : x;
  };
  float r = std::sqrt(q.x * q.x + q.y * q.y);
  float scale = 1;
  if (part.kind == Kind::kDisk) {
    const float kept = keep(r, part.lo, part.hi, part.lo > 0, true);
    scale = r > 0 ? kept / r : 1.0f;
    r = kept;
  } else if (part.kind == Kind::kCylinder) {
    q.z = keep(q.z, part.lo, part.hi, true, true);
  } else {
    const float z = keep(q.z, part.lo, part.hi, part.lo > -1, part.hi < 1);
    const float kept = std::sqrt(std::max(0.0f, (1 - z) * (1 + z)));
    if (z != q.z && r > 0) scale = kept / r, q.z = z;
  }
  if (scale != 1) q.x *= scale, q.y *= scale;
  if (part.is_full_circle() || !(r > 0)) return q;
  // A point beyond the first edge has an angle just under a full turn.
  float phi = azimuth(q.x, q.y);
  if (phi > part.phi_max && 2 * kPi - phi < phi - part.phi_max) phi = 0;
  const float kept = keep(phi, 0, part.phi_max, true, true);
  return kept == phi ? q : Vec3{r * std::cos(kept), r * std::sin(kept), q.z};
}

// Of a whole ellipsoid.
double ellipsoid_area(const Affine& m) {
  // Semi-axes a >= b >= c are the singular values of the linear part: eigenvalues of its Gram matrix G by the
  // trigonometric solution (Smith 1961), c from the determinant, which keeps it exact for flat ellipsoids.
  const Vec3d x = to_double(m.x), y = to_double(m.y), z = to_double(m.z);
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

Quadric::Quadric(const Transform& unit_to_world, bool flip, const QuadricPart& which)
    : to_world(unit_to_world.matrix()), to_object(unit_to_world.inverse_matrix()), flip_ng(flip), part(which) {
  const Bounds3 box = bounds();
  for (const Point3d corner : {box.lo, box.hi}) edge_slack = std::max(edge_slack, unit_error(*this, to_float(corner)));
}

std::optional<Quadric::Intersection> Quadric::intersect(Point3 o, Vec3 d, float t_max, float t_min) const {
  const Vec3d oo = point_in_double(to_object, as_vector(o));
  const Vec3d dd = vector_in_double(to_object, to_double(d));
  if (part.kind == Kind::kDisk) {
    const double t = -oo.z / dd.z;
    const float rounded = static_cast<float>(t);
    if (!(rounded > t_min && rounded < t_max)) return {};  // also when dd.z is 0
    const Vec3d q{oo.x + t * dd.x, oo.y + t * dd.y, 0};
    if (!is_inside(part, edge_slack, q)) return {};
    return Intersection{rounded, to_float(q)};
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
    if (is_inside(part, edge_slack, q)) return Intersection{t, to_float(q)};
  }
  return {};
}

Vec3 Quadric::unit_point(Point3 p) const {
  Vec3d q = point_in_double(to_object, as_vector(p));
  if (part.kind == Kind::kDisk) q.z = 0;
  if (part.kind == Kind::kSphere) q = normalize(q);
  if (part.kind == Kind::kCylinder) {
    const double scale = 1.0 / std::sqrt(q.x * q.x + q.y * q.y);
    q.x *= scale, q.y *= scale;
  }
  return to_float(q);
}

Bounds3 Quadric::bounds() const {
  return box_around(part, to_double(to_world.x), to_double(to_world.y), to_double(to_world.z), to_double(to_world.t));
}

Bounds3 quadric_bounds(const QuadricPart& part, const Transform& unit_to_space) {
  const auto& m = unit_to_space.matrix().m;
  const auto column = [&m](size_t i) { return Vec3d{m[0][i], m[1][i], m[2][i]}; };
  return box_around(part, column(0), column(1), column(2), column(3));
}

SurfacePoint quadric_point(const Quadric& quadric, Vec3 hit) {
  const Affine& to_object = quadric.to_object;
  const QuadricPart& part = quadric.part;
  const Vec3 q = part.is_full_sphere() ? hit : away_from_edges(part, unit_error(quadric, quadric.point(hit)), hit);
  SurfacePoint s;
  const Vec3d p = point_in_double(quadric.to_world, to_double(q));
  s.p = to_float(Point3d{p.x, p.y, p.z});
  s.ng = s.ns = quadric.normal(q);

  // Distance off the surface is measured by a function f of the unit shape, |q| - 1 for a sphere, whose gradient in the
  // world has length |M^-T n|. With u = 2^-24 its errors are: rounding p, u |n|.|M^-1||p|; rounding of the map's
  // entries, the same plus u |n|.|M^-1||t|; that of the inverse, both again; q not lying on the unit shape, 2u. Double
  // arithmetic adds nothing to these. Factor 4.
  const Vec3 n = quadric.unit_normal(q), an = abs(n);
  const Vec3 size = abs(s.p - Point3{}) + abs(quadric.to_world.t);
  const Vec3 per_axis{dot(abs(to_object.x), an), dot(abs(to_object.y), an), dot(abs(to_object.z), an)};
  s.p_error = 0x1p-22f * (dot(per_axis, size) + 1.0f) / length(to_object.transposed(n));

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
  s.dpdu = quadric.to_world.vector({-part.phi_max * q.y, part.phi_max * q.x, 0.0f});
  s.dpdv = quadric.to_world.vector(dqdv);
  return s;
}

float quadric_area_stretch(const Quadric& quadric, Vec3 q) {
  return area_stretch(quadric.to_world, quadric.to_object, quadric.unit_normal(q));
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
      sum += static_cast<double>(quadric_area_stretch(quadric, {r * std::cos(phi), r * std::sin(phi), z}));
    }
  return static_cast<float>(part.area() * sum / (along * kAround));
}

SurfacePoint sample_quadric(const Quadric& quadric, Vec2 u, Vec3* q) {
  const QuadricPart& part = quadric.part;
  if (part.is_full_sphere()) {
    *q = sample_sphere_uniform(u);
  } else {
    const float phi = part.phi_max * u.y;
    const auto between = [&](float lo, float hi) { return lo + (hi - lo) * u.x; };
    const float z = part.kind == Kind::kDisk ? 0.0f : between(part.lo, part.hi);
    const float r = part.kind == Kind::kDisk     ? std::sqrt(between(part.lo * part.lo, part.hi * part.hi))
                    : part.kind == Kind::kSphere ? std::sqrt(std::max(0.0f, (1 - z) * (1 + z)))
                                                 : 1.0f;
    *q = {r * std::cos(phi), r * std::sin(phi), z};
  }
  return quadric_point(quadric, *q);
}

}  // namespace etd
