// Everything in double: patches are rare beside triangles, and their equation cancels where they are nearly flat.
#include "shapes/patch.h"

#include <algorithm>
#include <cmath>

namespace etd {
namespace {

// How far beyond its edges a patch is met, in u and v.
constexpr double kEdgeSlack = 0x1p-20;
constexpr double kEdgeDistance = 0x1p-20;
constexpr double kUnit = 0x1p-24;

struct Patch {
  Point3d p[4];  // at (0, 0), (1, 0), (0, 1), (1, 1)

  Patch(const PatchMesh& mesh, uint32_t patch) {
    for (size_t i = 0; i < 4; ++i) p[i] = to_double(mesh.positions[mesh.patches[patch][i]]);
  }
  Point3d at(double u, double v) const {
    const Point3d a = p[0] + (p[1] - p[0]) * u, b = p[2] + (p[3] - p[2]) * u;
    return a + (b - a) * v;
  }
  Vec3d du(double v) const { return (p[1] - p[0]) * (1 - v) + (p[3] - p[2]) * v; }
  Vec3d dv(double u) const { return (p[2] - p[0]) * (1 - u) + (p[3] - p[1]) * u; }
  // Returns the area of the surface per area of (u, v).
  double stretch(double u, double v) const { return length(cross(du(v), dv(u))); }
  // Unit normal; at a corner that two edges share with no angle between them, that of the middle.
  Vec3d normal(double u, double v) const {
    for (const Vec3d n : {cross(du(v), dv(u)), cross(du(0.5), dv(0.5))})
      if (const double l = length(n); l > 0) return n * (1 / l);
    return {0, 0, 1};
  }
};

template <class T>
T blend(const T (&at)[4], float u, float v) {
  return at[0] * ((1 - u) * (1 - v)) + at[1] * (u * (1 - v)) + at[2] * ((1 - u) * v) + at[3] * (u * v);
}

// Shares of area around the corners: the density of sample_patch() in (u, v) up to its mean.
struct CornerShares {
  double w[4];

  explicit CornerShares(const Patch& patch) {
    for (int i = 0; i < 4; ++i) w[i] = patch.stretch(i & 1, i >> 1);
    // Without area at the corners, or with it at one alone, the density would vanish where the surface does not.
    const double middle = patch.stretch(0.5, 0.5), least = 0.05 * std::max(middle, (w[0] + w[1] + w[2] + w[3]) / 4);
    for (double& x : w) x = std::max(x, least);
  }
  double sum() const { return w[0] + w[1] + w[2] + w[3]; }
  double density(double u, double v) const {
    if (!(sum() > 0)) return 1;
    return 4 * ((w[0] * (1 - u) + w[1] * u) * (1 - v) + (w[2] * (1 - u) + w[3] * u) * v) / sum();
  }
};

// x in [0, 1] with density proportional to a (1 - x) + b x.
double sample_linear(double u, double a, double b) {
  if (!(a + b > 0)) return u;
  return u * (a + b) / (a + std::sqrt((1 - u) * a * a + u * b * b));
}

void set_parametrisation(const PatchMesh& mesh, const std::array<uint32_t, 4>& index, const Patch& patch, float u,
                         float v, SurfacePoint& s) {
  const Vec3d du = patch.du(static_cast<double>(v)), dv = patch.dv(static_cast<double>(u));
  s.parameters = s.uv = {u, v};
  s.dpdu = to_float(du);
  s.dpdv = to_float(dv);
  if (mesh.uvs.empty()) return;
  const Vec2 uv[4] = {mesh.uvs[index[0]], mesh.uvs[index[1]], mesh.uvs[index[2]], mesh.uvs[index[3]]};
  const auto bilinear = [&](double a, double b, double c, double d) {
    return (a * (1 - u) + b * u) * (1 - v) + (c * (1 - u) + d * u) * v;
  };
  s.uv = {static_cast<float>(bilinear(uv[0].x, uv[1].x, uv[2].x, uv[3].x)),
          static_cast<float>(bilinear(uv[0].y, uv[1].y, uv[2].y, uv[3].y))};
  // (dpdu, dpdv) = (dpds, dpdt) (d(s, t) / d(u, v)).
  const auto slope = [](double a, double b, double c, double d, double x) { return (b - a) * (1 - x) + (d - c) * x; };
  const double su = slope(uv[0].x, uv[1].x, uv[2].x, uv[3].x, v), tu = slope(uv[0].y, uv[1].y, uv[2].y, uv[3].y, v);
  const double sv = slope(uv[0].x, uv[2].x, uv[1].x, uv[3].x, u), tv = slope(uv[0].y, uv[2].y, uv[1].y, uv[3].y, u);
  const double det = su * tv - sv * tu;
  if (det == 0) return;
  const Vec3 dpds = to_float((du * tv - dv * tu) * (1 / det)), dpdt = to_float((dv * su - du * sv) * (1 / det));
  if (!is_finite(dpds) || !is_finite(dpdt) || dpds == Vec3{}) return;
  s.dpdu = dpds;
  s.dpdv = dpdt;
}

}  // namespace

// A ray and the lines of constant u (Reshetov 2019, "Cool Patches: A Geometric Approach to Ray/Bilinear Patch
// Intersections"): the signed volume that the ray spans with the line at u is quadratic in u, and its roots are the
// lines that it meets; t and v follow from where ray and line are nearest.
std::optional<PatchIntersection> intersect_patch(const PatchMesh& mesh, uint32_t index, Point3 origin, Vec3 direction,
                                                 float t_max, float t_min) {
  const Patch patch(mesh, index);
  const Point3d o = to_double(origin);
  const Vec3d d = to_double(direction);
  const Vec3d p00 = patch.p[0] - o, p10 = patch.p[1] - o;
  const Vec3d e0 = patch.p[2] - patch.p[0], e1 = patch.p[3] - patch.p[1];
  const double a0 = dot(cross(p00, d), e0);
  const double a2 = dot(cross(patch.p[1] - patch.p[0], patch.p[2] - patch.p[3]), d);
  const double a1 = dot(cross(p10, d), e1) - a0 - a2;
  const double discriminant = a1 * a1 - 4 * a0 * a2;
  if (!(discriminant >= 0)) return {};
  // Both roots without cancellation; of a flat patch, where a2 is nothing, one is at infinity.
  const double q = -0.5 * (a1 + std::copysign(std::sqrt(discriminant), a1));
  std::optional<PatchIntersection> nearest;
  for (const double u : {q / a2, a0 / q}) {
    if (!(u >= -kEdgeSlack && u <= 1 + kEdgeSlack)) continue;
    const Vec3d along = e0 + (e1 - e0) * u, start = p00 + (p10 - p00) * u;
    const Vec3d across = cross(d, along);
    const double scale = 1 / dot(across, across);
    const double v = dot(cross(across, start), d) * scale;
    const auto t = static_cast<float>(dot(cross(across, start), along) * scale);
    if (!(v >= -kEdgeSlack && v <= 1 + kEdgeSlack && t > t_min && t < t_max)) continue;
    if (!nearest || t < nearest->t) nearest = {t, static_cast<float>(u), static_cast<float>(v)};
  }
  return nearest;
}

SurfacePoint patch_point(const PatchMesh& mesh, uint32_t index, float u0, float v0, float margin) {
  const Patch patch(mesh, index);
  const auto& corners = mesh.patches[index];
  double u = std::clamp(static_cast<double>(u0), 0.0, 1.0), v = std::clamp(static_cast<double>(v0), 0.0, 1.0);
  // Rounding of the point to float; and, for a patch in a plane of coordinates, where that is nothing, of
  // intersections.
  const double solving = 0x1p-10 * kUnit * (length(patch.du(v)) + length(patch.dv(u)));
  const auto error_at = [solving](Point3d p, Vec3d n) {
    return solving + 2 * kUnit * (std::abs(n.x * p.x) + std::abs(n.y * p.y) + std::abs(n.z * p.z));
  };
  const double error = error_at(patch.at(u, v), patch.normal(u, v));
  const auto keep = [&](double x, double size) {
    const double inset = std::min(0.125, std::max(kEdgeDistance, 4 * (error + static_cast<double>(margin)) / size));
    return std::clamp(x, inset, 1 - inset);
  };
  u = keep(u, length(patch.du(v)));
  v = keep(v, length(patch.dv(u)));
  const Point3d p = patch.at(u, v);
  const Vec3d n = patch.normal(u, v);

  SurfacePoint s;
  s.p = to_float(p);
  s.p_error = next_up(static_cast<float>(error_at(p, n)));
  s.ng = s.ns = to_float(mesh.flip_ng ? -n : n);
  const auto fu = static_cast<float>(u), fv = static_cast<float>(v);
  if (!mesh.normals.empty()) {
    Vec3 vertex[4];
    for (size_t i = 0; i < 4; ++i) {
      vertex[i] = mesh.normals[corners[i]];
      if (vertex[i] == Vec3{}) vertex[i] = s.ng;
    }
    const Vec3 sum = blend(vertex, fu, fv);
    if (const float l = length(sum); l > 0.0f && std::isfinite(l)) s.ns = sum * (1.0f / l);
    s.ng = face_forward(s.ng, s.ns);
  }
  set_parametrisation(mesh, corners, patch, fu, fv, s);
  return s;
}

Bounds3 patch_bounds(const PatchMesh& mesh, uint32_t index) {
  Bounds3 box;
  for (const uint32_t i : mesh.patches[index]) box.extend(to_double(mesh.positions[i]));
  return box;
}

float patch_area(const PatchMesh& mesh, uint32_t index) {
  const Patch patch(mesh, index);
  constexpr int kPoints = 32;
  double sum = 0;
  for (int i = 0; i < kPoints; ++i)
    for (int j = 0; j < kPoints; ++j) sum += patch.stretch((i + 0.5) / kPoints, (j + 0.5) / kPoints);
  return static_cast<float>(sum / (kPoints * kPoints));
}

SurfacePoint sample_patch(const PatchMesh& mesh, uint32_t index, Vec2 u) {
  const CornerShares shares{Patch(mesh, index)};
  const double v = sample_linear(static_cast<double>(u.y), shares.w[0] + shares.w[1], shares.w[2] + shares.w[3]);
  const double x = sample_linear(static_cast<double>(u.x), shares.w[0] * (1 - v) + shares.w[2] * v,
                                 shares.w[1] * (1 - v) + shares.w[3] * v);
  return patch_point(mesh, index, static_cast<float>(x), static_cast<float>(v));
}

float patch_pdf_area(const PatchMesh& mesh, uint32_t index, Vec2 at) {
  const Patch patch(mesh, index);
  const double u = static_cast<double>(at.x), v = static_cast<double>(at.y), stretch = patch.stretch(u, v);
  return stretch > 0 ? static_cast<float>(CornerShares(patch).density(u, v) / stretch) : 0.0f;
}

}  // namespace etd
