#include "lights/light_surfaces.h"

namespace etd {

namespace {

Point3d vertex(const Mesh& mesh, uint32_t i) { return to_double(mesh.positions[i]); }

// Barycentrics (of the second and third corner) of the point of the triangle's plane nearest to `at`.
Vec2T<double> barycentrics(const Mesh& mesh, uint32_t triangle, Point3d at) {
  const auto& index = mesh.triangles[triangle];
  const Point3d p0 = vertex(mesh, index[0]);
  const Vec3d e1 = vertex(mesh, index[1]) - p0, e2 = vertex(mesh, index[2]) - p0, d = at - p0;
  const Vec3d n = cross(e1, e2);
  const double scale = 1.0 / dot(n, n);
  return {dot(cross(d, e2), n) * scale, dot(cross(e1, d), n) * scale};
}

SurfacePoint point_of_triangle(const Mesh& mesh, uint32_t triangle, Vec2T<double> b) {
  const double b1 = std::clamp(b.x, 0.0, 1.0), b2 = std::clamp(b.y, 0.0, 1.0 - b1);
  return triangle_point(mesh, triangle, static_cast<float>(b1), static_cast<float>(b2));
}

// Whether the edges x and y from a corner make a rectangle with the corner opposite to it. Rounded corners are
// forgiven; anything more would move light.
bool is_rectangle(Vec3d x, Vec3d y, Vec3d opposite) {
  constexpr double kTolerance = 1e-6;
  const double xx = dot(x, x), yy = dot(y, y);
  const Vec3d gap = opposite - x - y;
  return xx > 0 && yy > 0 && std::abs(dot(x, y)) <= kTolerance * std::sqrt(xx * yy) &&
         dot(gap, gap) <= sqr(kTolerance) * std::min(xx, yy);
}

// Of a mesh with normals each point may have the normal of either side, if the corners do not agree.
SurfaceBounds triangle_bounds(const Mesh& mesh, uint32_t triangle) {
  SurfaceBounds all;
  for (const uint32_t i : mesh.triangles[triangle]) all.box.extend(vertex(mesh, i));
  const Vec3 n = triangle_point(mesh, triangle, 0, 0).ng;
  all.normals = {n, 0, false};
  if (mesh.normals.empty()) return all;
  for (const auto& [b1, b2] : {std::pair(1.0f, 0.0f), std::pair(0.0f, 1.0f)})
    if (dot(triangle_point(mesh, triangle, b1, b2).ng, n) < 0.0f) all.normals.both = true;
  return all;
}

}  // namespace

std::optional<TriangleSurface::View> TriangleSurface::seen_from(Point3 p) const {
  const auto& index = mesh_->triangles[triangle_];
  const Point3d corners[3] = {vertex(*mesh_, index[0]), vertex(*mesh_, index[1]), vertex(*mesh_, index[2])};
  const SphericalTriangle seen(to_double(p), corners);
  if (!(seen.solid_angle() > kSmallSolidAngle)) return {};
  return View{*this, p, seen};
}

SurfacePoint TriangleSurface::View::sample(Vec2 u) const {
  const Mesh& mesh = *surface.mesh_;
  const auto& index = mesh.triangles[surface.triangle_];
  const Point3d o = to_double(p), p0 = vertex(mesh, index[0]);
  const Vec3d n = cross(vertex(mesh, index[1]) - p0, vertex(mesh, index[2]) - p0), w = seen.sample(u);
  const Point3d at = o + w * (dot(p0 - o, n) / dot(w, n));
  return point_of_triangle(mesh, surface.triangle_, barycentrics(mesh, surface.triangle_, at));
}

std::optional<RectangleSurface> RectangleSurface::find(const Mesh& mesh, uint32_t first) {
  if (first + 1 >= mesh.triangles.size()) return {};
  const auto &a = mesh.triangles[first], &b = mesh.triangles[first + 1];
  // The corner of the first triangle that faces the shared edge, and the corner opposite to it.
  const auto position = [&](uint32_t i) { return mesh.positions[i]; };
  const auto in_b = [&](uint32_t v) {
    return position(v) == position(b[0]) || position(v) == position(b[1]) || position(v) == position(b[2]);
  };
  int alone = -1, shared = 0;
  for (int i = 0; i < 3; ++i) in_b(a[static_cast<size_t>(i)]) ? void(++shared) : void(alone = i);
  if (shared != 2 || alone < 0) return {};
  RectangleSurface r;
  r.mesh_ = &mesh;
  r.first_ = first;
  r.corner_ = a[static_cast<size_t>(alone)];
  r.end_x_ = a[static_cast<size_t>((alone + 1) % 3)];
  r.end_y_ = a[static_cast<size_t>((alone + 2) % 3)];
  const auto is_shared = [&](uint32_t v) {
    return position(v) == position(r.end_x_) || position(v) == position(r.end_y_);
  };
  uint32_t opposite = b[0];
  int others = 0;
  for (const uint32_t v : b)
    if (!is_shared(v)) opposite = v, ++others;
  if (others != 1) return {};

  const Point3d o = vertex(mesh, r.corner_);
  const Vec3d x = vertex(mesh, r.end_x_) - o, y = vertex(mesh, r.end_y_) - o, d = vertex(mesh, opposite) - o;
  if (!is_rectangle(x, y, d)) return {};
  // Both triangles must face the same side.
  const Point3d b0 = vertex(mesh, b[0]);
  if (dot(cross(vertex(mesh, b[1]) - b0, vertex(mesh, b[2]) - b0), cross(x, y)) <= 0.0) return {};
  r.area_ = static_cast<float>(length(cross(x, y)));
  return r;
}

SurfacePoint RectangleSurface::point(double x, double y) const {
  const Point3d o = vertex(*mesh_, corner_);
  const Point3d at = o + (vertex(*mesh_, end_x_) - o) * x + (vertex(*mesh_, end_y_) - o) * y;
  // The first triangle is the half next to the corner.
  const uint32_t triangle = x + y <= 1.0 ? first_ : first_ + 1;
  return point_of_triangle(*mesh_, triangle, barycentrics(*mesh_, triangle, at));
}

std::optional<RectangleSurface::View> RectangleSurface::seen_from(Point3 p) const {
  const Point3d o = vertex(*mesh_, corner_);
  const SphericalRectangle seen(to_double(p), o, vertex(*mesh_, end_x_) - o, vertex(*mesh_, end_y_) - o);
  if (!(seen.solid_angle() > kSmallSolidAngle)) return {};
  return View{*this, seen};
}

QuadricSurface::QuadricSurface(const Quadric& quadric) : quadric_(&quadric), ball_radius_(length(quadric.to_world.x)) {
  const Affine3d& m = quadric.to_world;
  const double r2 = sqr(ball_radius_), tolerance = 1e-5 * r2;
  const auto differ = [tolerance](double a, double b) { return !(std::abs(a - b) <= tolerance); };
  if (!quadric.part.is_full_sphere() || differ(dot(m.y, m.y), r2) || differ(dot(m.z, m.z), r2) ||
      differ(dot(m.x, m.y), 0) || differ(dot(m.y, m.z), 0) || differ(dot(m.z, m.x), 0))
    ball_radius_ = 0.0;
}

std::optional<QuadricSurface::View> QuadricSurface::seen_from(Point3 p) const {
  if (!(ball_radius_ > 0.0)) return {};
  const auto cap = SphericalCap::seen_from(to_double(p), Point3d{} + quadric_->to_world.t, ball_radius_);
  if (!cap) return {};
  return View{*this, *cap};
}

SurfacePoint QuadricSurface::View::sample(Vec2 u) const {
  return quadric_point(*surface.quadric_, normalize(surface.quadric_->to_object.vector(seen.sample_normal(u))));
}

namespace {

// A corner of a patch and the edges from it along growing u and v.
struct PatchCorner {
  Point3d corner;
  Vec3d x, y, opposite;

  PatchCorner(const PatchMesh& mesh, uint32_t patch) {
    const auto position = [&](size_t i) { return to_double(mesh.positions[mesh.patches[patch][i]]); };
    corner = position(0);
    x = position(1) - corner, y = position(2) - corner, opposite = position(3) - corner;
  }
};

}  // namespace

PatchSurface::PatchSurface(const PatchMesh& mesh, uint32_t patch)
    : mesh_(&mesh), patch_(patch), area_(patch_area(mesh, patch)) {
  const PatchCorner at(mesh, patch);
  is_rectangle_ = is_rectangle(at.x, at.y, at.opposite);
}

std::optional<PatchSurface::View> PatchSurface::seen_from(Point3 p) const {
  if (!is_rectangle_) return {};
  const PatchCorner at(*mesh_, patch_);
  const SphericalRectangle seen(to_double(p), at.corner, at.x, at.y);
  if (!(seen.solid_angle() > kSmallSolidAngle)) return {};
  return View{*this, seen};
}

SurfacePoint PatchSurface::View::sample(Vec2 u) const {
  const Vec2T<double> at = seen.sample(u);
  return patch_point(*surface.mesh_, surface.patch_, static_cast<float>(at.x), static_cast<float>(at.y));
}

// The side of a triangle's normal is that of a linear function of the barycentrics, and so that of its corners where
// they agree.
SurfaceBounds TriangleSurface::bounds() const { return triangle_bounds(*mesh_, triangle_); }

SurfaceBounds RectangleSurface::bounds() const {
  SurfaceBounds all = triangle_bounds(*mesh_, first_);
  const SurfaceBounds second = triangle_bounds(*mesh_, first_ + 1);
  all.box.extend(second.box.lo);
  all.box.extend(second.box.hi);
  all.normals = unite(all.normals, second.normals);
  return all;
}

SurfaceBounds QuadricSurface::bounds() const {
  SurfaceBounds all{quadric_->bounds(), {}};
  if (quadric_->part.kind == QuadricPart::Kind::kDisk) all.normals = {quadric_->normal({0, 0, 0}), 0, false};
  return all;
}

// The normal dp/du x dp/dv is linear in u and in v, so that those of all points are positive sums of the four at the
// corners. With normals at the vertices, the side may change anywhere.
SurfaceBounds PatchSurface::bounds() const {
  SurfaceBounds all{patch_bounds(*mesh_, patch_), {}};
  if (!mesh_->normals.empty()) return all;
  std::optional<DirectionCone> cone;
  const auto position = [&](size_t i) { return to_double(mesh_->positions[mesh_->patches[patch_][i]]); };
  for (const bool u : {false, true})
    for (const bool v : {false, true}) {
      const Vec3d along_u = position(v ? 3 : 1) - position(v ? 2 : 0);
      const Vec3d along_v = position(u ? 3 : 2) - position(u ? 1 : 0);
      const Vec3d n = cross(along_u, along_v) * (mesh_->flip_ng ? -1.0 : 1.0);
      if (!(dot(n, n) > 0)) continue;
      const DirectionCone corner{to_float(normalize(n)), 0, false};
      cone = cone ? unite(*cone, corner) : corner;
    }
  if (cone && cone->spread < 0.5f * kPi) all.normals = *cone;
  return all;
}

}  // namespace etd
