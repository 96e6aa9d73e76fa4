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

// Each point of a mesh with normals may have the normal of either side, if the corners do not agree.
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

std::optional<LightRectangle> LightRectangle::find(const Mesh& mesh, uint32_t first) {
  if (first + 1 >= mesh.triangles.size()) return {};
  const auto &a = mesh.triangles[first], &b = mesh.triangles[first + 1];
  // The corner of the first triangle that faces the shared edge, and the corner opposite to it.
  const auto position = [&](uint32_t i) { return mesh.positions[i]; };
  const auto in_b = [&](uint32_t v) {
    return position(v) == position(b[0]) || position(v) == position(b[1]) || position(v) == position(b[2]);
  };
  size_t alone = 3;
  int shared = 0;
  for (size_t i = 0; i < 3; ++i) in_b(a[i]) ? void(++shared) : void(alone = i);
  if (shared != 2 || alone == 3) return {};
  const size_t at_x = (alone + 1) % 3, at_y = (alone + 2) % 3;  // in a, the neighbours of its lone corner
  const Point3 corner = position(a[alone]), end_x = position(a[at_x]), end_y = position(a[at_y]);
  // The same corners in b.
  size_t opposite = 3, also_x = 3, also_y = 3;
  for (size_t i = 0; i < 3; ++i) (position(b[i]) == end_x ? also_x : position(b[i]) == end_y ? also_y : opposite) = i;
  if (opposite == 3 || also_x == 3 || also_y == 3) return {};

  const Point3 across = position(b[opposite]);
  const Point3d o = to_double(corner);
  const Vec3d x = to_double(end_x) - o, y = to_double(end_y) - o;
  if (!is_rectangle(x, y, to_double(across) - o)) return {};
  // Both triangles must face the same side, the same one everywhere.
  const auto at_corner = [&](uint32_t triangle, size_t i) {
    return triangle_point(mesh, triangle, i == 1 ? 1.0f : 0.0f, i == 2 ? 1.0f : 0.0f);
  };
  const Vec3 ng = at_corner(first, 0).ng;
  const auto uv = [&](uint32_t triangle, size_t i) { return triangle_uv(mesh, triangle, i); };
  for (const uint32_t triangle : {first, first + 1})
    for (size_t i = 0; i < 3; ++i)
      if (!(dot(at_corner(triangle, i).ng, ng) > 0.0f)) return {};
  const Point3d b0 = vertex(mesh, b[0]);
  const Vec3d n = cross(x, y);
  if (!(dot(cross(vertex(mesh, b[1]) - b0, vertex(mesh, b[2]) - b0), n) > 0.0)) return {};
  const TriangleFace face_a = triangle_face(mesh, first), face_b = triangle_face(mesh, first + 1);
  return LightRectangle{
      .halves = {{corner, end_x, end_y, uv(first, alone), uv(first, at_x), uv(first, at_y), ng, face_a.error},
                 {across, end_y, end_x, uv(first + 1, opposite), uv(first + 1, also_y), uv(first + 1, also_x),
                  at_corner(first + 1, 0).ng, face_b.error}},
      .frame = {o, x, y},
      .area = static_cast<float>(length(n)),
      .edge = std::max(face_a.edge, face_b.edge)};
}

SurfacePoint RectangleSurface::point(Vec2T<double> at) const {
  const LightRectangle& r = *rectangle_;
  const bool near = at.x + at.y <= 1.0;
  const LightRectangle::Half& half = r.halves[near ? 0 : 1];
  double x = near ? at.x : 1.0 - at.x, y = near ? at.y : 1.0 - at.y;
  const auto blended = [&half](double bx, double by) {
    return blend(to_double(half.corner), to_double(half.end_x), to_double(half.end_y), 1.0 - bx - by, bx, by);
  };
  SurfacePoint s;
  s.ng = s.ns = half.ng;
  Point3d p = blended(x, y);
  s.p_error = point_error(p, half.ng, half.error);
  // Away from the edges of the rectangle, as triangle_point() keeps its points; the other triangle goes on behind the
  // third.
  const double nearest = nearest_edge(s.p_error, r.edge);
  if (!(x >= nearest && y >= nearest)) {
    x = std::max(x, nearest), y = std::max(y, nearest);
    p = blended(x, y);
  }
  s.p = to_float(p);
  const auto bx = static_cast<float>(x), by = static_cast<float>(y);
  s.uv = {half.uv.x + bx * (half.uv_x.x - half.uv.x) + by * (half.uv_y.x - half.uv.x),
          half.uv.y + bx * (half.uv_x.y - half.uv.y) + by * (half.uv_y.y - half.uv.y)};
  return s;
}

std::optional<RectangleSurface::View> RectangleSurface::seen_from(Point3 p) const {
  const SphericalRectangle seen(to_double(p), rectangle_->frame);
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
  const SphericalRectangle seen(to_double(p), {at.corner, at.x, at.y});
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
  const auto normals = [&](int half) { return DirectionCone{rectangle_->halves[half].ng, 0, false}; };
  SurfaceBounds all;
  all.normals = unite(normals(0), normals(1));
  for (const LightRectangle::Half& half : rectangle_->halves)
    for (const Point3 p : {half.corner, half.end_x, half.end_y}) all.box.extend(to_double(p));
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
