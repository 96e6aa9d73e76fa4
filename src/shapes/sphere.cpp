// Intersection, points and area of the unit sphere under an affine map. The intersection is solved in double: a sphere
// is one primitive among thousands of box tests, so this costs little and takes every question of cancellation away.
#include "shapes/sphere.h"

#include "core/warp.h"

namespace etd {
namespace {

Vec3d vector_in_double(const Affine& a, Vec3d v) {
  return to_double(a.x) * v.x + to_double(a.y) * v.y + to_double(a.z) * v.z;
}
Vec3d point_in_double(const Affine& a, Vec3d p) { return to_double(a.t) + vector_in_double(a, p); }
Vec3d as_vector(Point3 p) { return {p.x, p.y, p.z}; }

double determinant(const Affine& a) { return dot(to_double(a.x), cross(to_double(a.y), to_double(a.z))); }

}  // namespace

std::optional<Sphere::Intersection> Sphere::intersect(Point3 o, Vec3 d, float t_max) const {
  const Vec3d oo = point_in_double(to_object, as_vector(o));
  const Vec3d dd = vector_in_double(to_object, to_double(d));
  const double a = dot(dd, dd);
  if (!(a > 0.0)) return {};
  // The discriminant from the point of the line nearest to the centre, and the root that would cancel from the product
  // of the roots (Haines, Guenther and Akenine-Moeller 2019, "Precision Improvements for Ray/Sphere Intersection").
  const double b = -dot(oo, dd);
  const Vec3d nearest = oo + dd * (b / a);
  const double h2 = 1.0 - dot(nearest, nearest);
  if (!(h2 >= 0.0)) return {};
  const double c = dot(oo, oo) - 1.0;
  const double q = b + std::copysign(std::sqrt(a * h2), b);
  const double t_far_from_zero = q / a, t_other = q != 0.0 ? c / q : 0.0;
  const double roots[2] = {std::min(t_far_from_zero, t_other), std::max(t_far_from_zero, t_other)};
  for (int i = 0; i < 2; ++i) {
    const float t = static_cast<float>(roots[i]);
    if (!(t > 0.0f && t < t_max)) continue;
    const double along = std::sqrt(h2 / a) * (i == 0 ? -1.0 : 1.0);
    return Intersection{t, to_float(normalize(nearest + dd * along))};
  }
  return {};
}

SurfacePoint sphere_point(const Sphere& sphere, Vec3 n) {
  const Affine& to_object = sphere.to_object;
  SurfacePoint s;
  const Vec3d p = point_in_double(sphere.to_world, to_double(n));
  s.p = to_float(Point3d{p.x, p.y, p.z});
  s.ng = s.ns = sphere.normal(n);

  // Distance off the surface is measured by f(p) = |to_object(p)| - 1, whose gradient has length |M^-T n|. With
  // u = 2^-24 its errors are: rounding p, u |n|.|M^-1||p|; rounding of the map's entries, the same plus u
  // |n|.|M^-1||t|; that of the inverse, both again; n not being of unit length, 2u. Double arithmetic adds nothing to
  // these. Factor 4.
  const Vec3 size = abs(s.p - Point3{}) + abs(sphere.to_world.t);
  const Vec3 an = abs(n);
  const Vec3 per_axis{dot(abs(to_object.x), an), dot(abs(to_object.y), an), dot(abs(to_object.z), an)};
  s.p_error = 0x1p-22f * (dot(per_axis, size) + 1.0f) / length(to_object.transposed(n));

  const float phi = std::atan2(n.y, n.x);
  s.uv.x = (phi < 0.0f ? phi + 2.0f * kPi : phi) * (0.5f * kInvPi);
  // theta from its tangent: acos(z) would lose half the digits near the poles.
  s.uv.y = 1.0f - std::atan2(std::sqrt(n.x * n.x + n.y * n.y), n.z) * kInvPi;
  s.dpdu = sphere.to_world.vector({-2.0f * kPi * n.y, 2.0f * kPi * n.x, 0.0f});
  return s;
}

float sphere_area_stretch(const Sphere& sphere, Vec3 n) {
  return static_cast<float>(std::abs(determinant(sphere.to_world))) * length(sphere.to_object.transposed(n));
}

float sphere_area(const Sphere& sphere) {
  // Semi-axes a >= b >= c are the singular values of the linear part: eigenvalues of its Gram matrix G by the
  // trigonometric solution (Smith 1961), c from the determinant, which keeps it exact for flat ellipsoids.
  const Vec3d x = to_double(sphere.to_world.x), y = to_double(sphere.to_world.y), z = to_double(sphere.to_world.z);
  const double mean = (dot(x, x) + dot(y, y) + dot(z, z)) / 3.0;
  const double gx = dot(x, x) - mean, gy = dot(y, y) - mean, gz = dot(z, z) - mean;
  const double xy = dot(x, y), xz = dot(x, z), yz = dot(y, z);
  const double spread = std::sqrt((gx * gx + gy * gy + gz * gz + 2.0 * (xy * xy + xz * xz + yz * yz)) / 6.0);
  if (spread < 1e-6 * mean) return static_cast<float>(4.0 * M_PI * mean);
  const double det = gx * (gy * gz - yz * yz) - xy * (xy * gz - yz * xz) + xz * (xy * yz - gy * xz);
  const double angle = std::acos(std::min(1.0, std::max(-1.0, det / (2.0 * spread * spread * spread)))) / 3.0;
  const double a2 = mean + 2.0 * spread * std::cos(angle),
               c2 = mean + 2.0 * spread * std::cos(angle + 2.0 * M_PI / 3.0);
  const double a = std::sqrt(a2), b = std::sqrt(std::max(0.0, 3.0 * mean - a2 - c2));
  const double c = std::abs(determinant(sphere.to_world)) / (a * b);
  // Legendre's closed form: 2 pi c^2 + (2 pi a b / sin phi) (E(phi,k) sin^2 phi + F(phi,k) cos^2 phi) with
  // cos phi = c/a, k^2 = a^2 (b^2 - c^2) / (b^2 (a^2 - c^2)).
  const double cos_phi = std::min(1.0, c / a), phi = std::acos(cos_phi), sin_phi = std::sin(phi);
  const double k2 = (a * a) * (b * b - c * c) / ((b * b) * (a * a - c * c));
  const double k = std::sqrt(std::min(1.0, std::max(0.0, k2)));
  const double sum = std::ellint_2(k, phi) * sin_phi * sin_phi + std::ellint_1(k, phi) * cos_phi * cos_phi;
  return static_cast<float>(2.0 * M_PI * (c * c + a * b * sum / sin_phi));
}

SurfacePoint sample_sphere(const Sphere& sphere, Vec2 u, Vec3* n) {
  *n = sample_sphere_uniform(u);
  return sphere_point(sphere, *n);
}

}  // namespace etd
