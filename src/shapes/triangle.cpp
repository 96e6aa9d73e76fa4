// Points of triangles, with the error bound that keeps rays from meeting the triangle that they leave.
#include "shapes/triangle.h"

#include "core/warp.h"

namespace etd {
namespace {

constexpr double kUnit = 0x1p-24;  // largest relative error of rounding to float
constexpr double kEdgeDistance = 0x1p-20;
constexpr double kMaxCondition = 64.0;

// The moment between two motion steps of a mesh: where their vertices begin, and the share of the second. In float, as
// Embree finds it, so that both mean the same moment.
struct Moment {
  size_t first, second;
  float share;

  Moment(const Mesh& mesh, float time) {
    const float scaled = time * static_cast<float>(mesh.motion_steps - 1);
    const uint32_t step = std::min(static_cast<uint32_t>(scaled), mesh.motion_steps - 2);
    first = step * mesh.vertex_count();
    second = first + mesh.vertex_count();
    share = scaled - static_cast<float>(step);
  }
  Vec3d operator()(Vec3d a, Vec3d b) const { return a * (1.0 - double(share)) + b * double(share); }
};

Vec3d as_vector(Point3 p) { return {p.x, p.y, p.z}; }

// Interpolates the corners of a moving triangle. Returns the largest coordinates of the vertices that enter. It stands
// apart so that what triangles at rest need is small enough to be inlined.
Vec3d moving_corners(const Mesh& mesh, const std::array<uint32_t, 3>& index, float time, Point3d (&p)[3]) {
  const Moment at(mesh, time);
  Vec3d largest;
  for (int i = 0; i < 3; ++i) {
    const Vec3d a = as_vector(mesh.positions[at.first + index[i]]), b = as_vector(mesh.positions[at.second + index[i]]);
    p[i] = Point3d{} + at(a, b);
    for (int c = 0; c < 3; ++c) largest[c] = std::max({largest[c], std::abs(a[c]), std::abs(b[c])});
  }
  return largest;
}

// Length, shape and normal of a triangle, in double.
struct Face {
  Point3d p[3];
  Vec3d n;         // unit; along (p1 - p0) x (p2 - p0)
  double area2;    // twice the area
  double longest;  // edge
  double error;    // the part of the error bound below that is the same for all points

  Face(const Mesh& mesh, uint32_t triangle, float time) {
    const auto& index = mesh.triangles[triangle];
    Vec3d moving;  // largest coordinates of vertices that are interpolated
    if (mesh.motion_steps == 1)
      for (int i = 0; i < 3; ++i) p[i] = to_double(mesh.positions[index[i]]);
    else
      moving = moving_corners(mesh, index, time, p);
    const Vec3d a = p[1] - p[0], b = p[2] - p[0], c = p[2] - p[1];
    n = cross(a, b);
    area2 = length(n);
    const double inverse = 1.0 / area2;
    n = area2 > 0.0 ? n * inverse : Vec3d{0, 0, 1};
    const double aa = dot(a, a), bb = dot(b, b), cc = dot(c, c);
    longest = std::sqrt(std::max(aa, std::max(bb, cc)));
    error = 8.0 * kUnit * std::min(kMaxCondition * longest, std::sqrt(aa * bb * cc) * inverse);
    // Embree interpolates in float: 4 u |n|.|vertex| covers what that moves the plane.
    error += 4.0 * kUnit * (std::abs(n.x) * moving.x + std::abs(n.y) * moving.y + std::abs(n.z) * moving.z);
  }

  // How far from the plane a ray origin near `at` must be for the ray not to meet the triangle again. With u = 2^-24, L
  // the longest edge, and every vertex within L of the origin, the errors along the normal are
  //   - u |n|.|p|  from rounding p to float,
  //   - u L        from Embree's rounding of the vertices relative to the origin,
  //   - 4 u k L    from its normal, a cross product of two rounded edges e, f: |dN| <= 4 u |e||f| = 4 u k |N|, where
  //                k = |e||f| / |N| for the two shorter edges, which its stable_triangle_normal prefers,
  //   - 3 u L      from the dot product of a vertex with that normal.
  // As k >= 1, u (|n|.|p| + 8 k L) covers them; k L is the product of the edges over twice the area. Beyond k = 64 (an
  // obtuse sliver of height below L/256) the bound would push origins across neighbouring geometry; there we accept
  // that a sliver may shadow itself.
  double error_at(Point3d at) const {
    return kUnit * (std::abs(n.x * at.x) + std::abs(n.y * at.y) + std::abs(n.z * at.z)) + error;
  }

  // Smallest barycentric that keeps a point 4 * distance from the edges; at most 1/8 for triangles that are no larger
  // than their own error.
  double edge_distance(double distance) const {
    const double wanted = 4.0 * distance * longest / area2;
    return std::max(kEdgeDistance, wanted < 0.125 ? wanted : 0.125);
  }
};

Point3d blend(const Face& f, double b0, double b1, double b2) {
  return {b0 * f.p[0].x + b1 * f.p[1].x + b2 * f.p[2].x, b0 * f.p[0].y + b1 * f.p[1].y + b2 * f.p[2].y,
          b0 * f.p[0].z + b1 * f.p[1].z + b2 * f.p[2].z};
}

// Interpolated vertex normal; a zero vertex normal stands for the face's.
Vec3 blend_normals(const Mesh& mesh, const std::array<uint32_t, 3>& index, float time, Vec3 face, Vec3 b) {
  const auto normal = [&](uint32_t vertex) {
    if (mesh.motion_steps == 1) return mesh.normals[vertex];
    const Moment at(mesh, time);
    return to_float(at(to_double(mesh.normals[at.first + vertex]), to_double(mesh.normals[at.second + vertex])));
  };
  Vec3 sum;
  for (int i = 0; i < 3; ++i) {
    const Vec3 n = normal(index[i]);
    sum += (n == Vec3{} ? face : n) * b[i];
  }
  const float l = length(sum);
  return l > 0.0f && std::isfinite(l) ? sum * (1.0f / l) : face;
}

// uv, dp/du and dp/dv. Solves (p1 - p0, p2 - p0) = (dpdu, dpdv) (uv1 - uv0, uv2 - uv0); where the uvs span no area,
// they are those of the default parametrisation.
void set_parametrisation(const Mesh& mesh, const std::array<uint32_t, 3>& index, const Face& f, Vec3 b,
                         SurfacePoint& s) {
  const Vec3d e1 = f.p[1] - f.p[0], e2 = f.p[2] - f.p[0];
  s.dpdu = to_float(e1);
  s.dpdv = to_float(e2 - e1);
  if (mesh.uvs.empty()) {
    s.uv = {b.y + b.z, b.z};
    return;
  }
  const Vec2 uv0 = mesh.uvs[index[0]], uv1 = mesh.uvs[index[1]], uv2 = mesh.uvs[index[2]];
  s.uv = {b.x * uv0.x + b.y * uv1.x + b.z * uv2.x, b.x * uv0.y + b.y * uv1.y + b.z * uv2.y};
  const double u1 = double(uv1.x) - uv0.x, v1 = double(uv1.y) - uv0.y;
  const double u2 = double(uv2.x) - uv0.x, v2 = double(uv2.y) - uv0.y;
  const double det = u1 * v2 - u2 * v1;
  if (det == 0.0) return;
  const Vec3 dpdu = to_float((e1 * v2 - e2 * v1) * (1.0 / det));
  const Vec3 dpdv = to_float((e2 * u1 - e1 * u2) * (1.0 / det));
  if (is_finite(dpdu) && is_finite(dpdv) && !(dpdu == Vec3{})) s.dpdu = dpdu, s.dpdv = dpdv;
}

}  // namespace

Point3 triangle_position(const Mesh& mesh, uint32_t triangle, float b1, float b2, float time) {
  if (mesh.motion_steps > 1)
    return to_float(blend(Face(mesh, triangle, time), 1.0 - double(b1) - double(b2), double(b1), double(b2)));
  const auto& index = mesh.triangles[triangle];
  const Point3 p0 = mesh.positions[index[0]];
  return p0 + (mesh.positions[index[1]] - p0) * b1 + (mesh.positions[index[2]] - p0) * b2;
}

SurfacePoint triangle_point(const Mesh& mesh, uint32_t triangle, float b1, float b2, float time, float margin) {
  const auto& index = mesh.triangles[triangle];
  const Face f(mesh, triangle, time);
  double c1 = b1, c2 = b2, c0 = 1.0 - c1 - c2;
  Point3d p = blend(f, c0, c1, c2);
  const double error = f.error_at(p), nearest = f.edge_distance(error + margin);
  if (!(c0 >= nearest && c1 >= nearest && c2 >= nearest)) {
    c0 = std::max(c0, nearest), c1 = std::max(c1, nearest), c2 = std::max(c2, nearest);
    const double scale = 1.0 / (c0 + c1 + c2);
    c0 *= scale, c1 *= scale, c2 *= scale;
    p = blend(f, c0, c1, c2);
  }
  const Vec3 b = to_float(Vec3d{c0, c1, c2});

  SurfacePoint s;
  s.p = to_float(p);
  s.p_error = next_up(static_cast<float>(error));
  s.ng = to_float(mesh.flip_ng ? -f.n : f.n);
  s.ns = s.ng;
  if (!mesh.normals.empty()) {
    s.ns = blend_normals(mesh, index, time, s.ng, b);
    s.ng = face_forward(s.ng, s.ns);
  }
  set_parametrisation(mesh, index, f, b, s);
  return s;
}

float triangle_area(const Mesh& mesh, uint32_t triangle) {
  return static_cast<float>(0.5 * Face(mesh, triangle, 0).area2);
}

SurfacePoint sample_triangle(const Mesh& mesh, uint32_t triangle, Vec2 u) {
  const Vec2 b = sample_triangle_uniform(u);
  return triangle_point(mesh, triangle, b.y, std::max(0.0f, 1.0f - b.x - b.y));
}

}  // namespace etd
