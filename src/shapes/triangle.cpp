// Points of triangles, with the error bound that keeps rays from meeting the triangle that they leave.
#include "shapes/triangle.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/warp.h"

namespace etd {
namespace {

constexpr double kUnit = 0x1p-24;  // largest relative error of rounding to float
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

struct Corners {
  Point3d p0, p1, p2;
  Vec3d moving;  // largest coordinates of vertices that are interpolated
};

Corners corners_at_rest(const Mesh& mesh, const std::array<uint32_t, 3>& index) {
  return {to_double(mesh.positions[index[0]]), to_double(mesh.positions[index[1]]), to_double(mesh.positions[index[2]]),
          Vec3d{}};
}

// It stands apart so that what triangles at rest need is small enough to be inlined.
Corners moving_corners(const Mesh& mesh, const std::array<uint32_t, 3>& index, float time) {
  const Moment at(mesh, time);
  Corners corners;
  Point3d* const out[3] = {&corners.p0, &corners.p1, &corners.p2};
  for (size_t i = 0; i < 3; ++i) {
    const Vec3d a = as_vector(mesh.positions[at.first + index[i]]), b = as_vector(mesh.positions[at.second + index[i]]);
    *out[i] = Point3d{} + at(a, b);
    for (int c = 0; c < 3; ++c) corners.moving[c] = std::max({corners.moving[c], std::abs(a[c]), std::abs(b[c])});
  }
  return corners;
}

float rounded_up(double x) { return next_up(static_cast<float>(x)); }

// It computes in double, because edges are small beside coordinates.
TriangleFace face_of(const Corners& v) {
  const Vec3d a = v.p1 - v.p0, b = v.p2 - v.p0, c = v.p2 - v.p1, across = cross(a, b);
  const double area2 = length(across), inverse = 1.0 / area2;
  const Vec3d n = area2 > 0.0 ? across * inverse : Vec3d{0, 0, 1};
  const double aa = dot(a, a), bb = dot(b, b), cc = dot(c, c), longest = std::sqrt(std::max(aa, std::max(bb, cc)));
  double error = 8.0 * kUnit * std::min(kMaxCondition * longest, std::sqrt(aa * bb * cc) * inverse);
  // Embree interpolates in float: 4 u |n|.|vertex| covers what that moves the plane.
  error += 4.0 * kUnit * (std::abs(n.x) * v.moving.x + std::abs(n.y) * v.moving.y + std::abs(n.z) * v.moving.z);
  return {to_float(n), rounded_up(error), rounded_up(4.0 * longest * inverse)};
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

// dp/du and dp/dv of a mesh with uvs. Solves (p1 - p0, p2 - p0) = (dpdu, dpdv) (uv1 - uv0, uv2 - uv0); where the uvs
// span no area, they stay those of the default parametrisation.
void set_tangents(const Mesh& mesh, const std::array<uint32_t, 3>& index, const Corners& v, SurfacePoint& s) {
  const Vec3d e1 = v.p1 - v.p0, e2 = v.p2 - v.p0;
  const Vec2 uv0 = mesh.uvs[index[0]], uv1 = mesh.uvs[index[1]], uv2 = mesh.uvs[index[2]];
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
  const auto& index = mesh.triangles[triangle];
  if (mesh.motion_steps > 1) {
    const Corners v = moving_corners(mesh, index, time);
    return to_float(blend(v.p0, v.p1, v.p2, 1.0 - double(b1) - double(b2), double(b1), double(b2)));
  }
  const Point3 p0 = mesh.positions[index[0]];
  return p0 + (mesh.positions[index[1]] - p0) * b1 + (mesh.positions[index[2]] - p0) * b2;
}

SurfacePoint triangle_point(const Mesh& mesh, uint32_t triangle, float b1, float b2, float time, float margin,
                            bool tangents) {
  const auto& index = mesh.triangles[triangle];
  const Corners v = mesh.motion_steps == 1 ? corners_at_rest(mesh, index) : moving_corners(mesh, index, time);
  const TriangleFace face = mesh.faces.empty() ? face_of(v) : mesh.faces[triangle];
  double c1 = b1, c2 = b2, c0 = 1.0 - c1 - c2;
  Point3d p = blend(v.p0, v.p1, v.p2, c0, c1, c2);
  SurfacePoint s;
  s.p_error = point_error(p, face.n, face.error);
  const double nearest = nearest_edge(s.p_error + margin, face.edge);
  if (!(c0 >= nearest && c1 >= nearest && c2 >= nearest)) {
    c0 = std::max(c0, nearest), c1 = std::max(c1, nearest), c2 = std::max(c2, nearest);
    const double scale = 1.0 / (c0 + c1 + c2);
    c0 *= scale, c1 *= scale, c2 *= scale;
    p = blend(v.p0, v.p1, v.p2, c0, c1, c2);
  }
  const Vec3 b = to_float(Vec3d{c0, c1, c2});

  s.p = to_float(p);
  s.ng = mesh.flip_ng ? -face.n : face.n;
  s.ns = s.ng;
  if (!mesh.normals.empty()) {
    s.ns = blend_normals(mesh, index, time, s.ng, b);
    s.ng = face_forward(s.ng, s.ns);
  }
  s.dpdu = to_float(v.p1 - v.p0);
  s.dpdv = to_float(v.p2 - v.p1);
  if (mesh.uvs.empty()) {
    s.uv = {b.y + b.z, b.z};
    return s;
  }
  const Vec2 uv0 = mesh.uvs[index[0]], uv1 = mesh.uvs[index[1]], uv2 = mesh.uvs[index[2]];
  s.uv = {b.x * uv0.x + b.y * uv1.x + b.z * uv2.x, b.x * uv0.y + b.y * uv1.y + b.z * uv2.y};
  if (tangents) set_tangents(mesh, index, v, s);
  return s;
}

TriangleFace triangle_face(const Mesh& mesh, uint32_t triangle) {
  return face_of(corners_at_rest(mesh, mesh.triangles[triangle]));
}

void prepare_faces(Mesh& mesh) {
  if (mesh.motion_steps > 1) return;
  mesh.faces.resize(mesh.triangles.size());
  tbb::parallel_for(tbb::blocked_range<size_t>(0, mesh.triangles.size(), 4096), [&](const auto& range) {
    for (size_t i = range.begin(); i < range.end(); ++i) mesh.faces[i] = triangle_face(mesh, static_cast<uint32_t>(i));
  });
}

Vec2 triangle_uv(const Mesh& mesh, uint32_t triangle, size_t corner) {
  if (!mesh.uvs.empty()) return mesh.uvs[mesh.triangles[triangle][corner]];
  return {corner == 0 ? 0.0f : 1.0f, corner == 2 ? 1.0f : 0.0f};
}

float triangle_area(const Mesh& mesh, uint32_t triangle) {
  const Corners v = corners_at_rest(mesh, mesh.triangles[triangle]);
  return static_cast<float>(0.5 * length(cross(v.p1 - v.p0, v.p2 - v.p0)));
}

SurfacePoint sample_triangle(const Mesh& mesh, uint32_t triangle, Vec2 u) {
  const Vec2 b = sample_triangle_uniform(u);
  return triangle_point(mesh, triangle, b.y, std::max(0.0f, 1.0f - b.x - b.y));
}

}  // namespace etd
