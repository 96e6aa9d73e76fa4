#include "scene/place_vertices.h"

#include "shapes/cut_patches.h"
#include "shapes/cut_triangles.h"

namespace etd {

namespace {

// The accelerator may read a little beyond the last vertex.
std::vector<Point3> rounded(const std::vector<Point3d>& points, const Transform& t) {
  std::vector<Point3> positions;
  positions.reserve(points.size() + 1);
  for (const Point3d& p : points) positions.push_back(to_float(t.point(p)));
  return positions;
}

// A Mesh or PatchMesh with everything but its faces.
template <class M>
M place_vertices(const MeshData& data, const Transform& t, bool reverse) {
  M mesh;
  mesh.positions = rounded(data.positions, t);
  mesh.normals.reserve(data.normals.size());
  for (const Vec3& n : data.normals) {
    const Vec3d m = t.normal(to_double(reverse ? -n : n));
    const double l = length(m);
    mesh.normals.push_back(l > 0 && std::isfinite(l) ? to_float(m * (1.0 / l)) : Vec3{});
  }
  mesh.uvs = data.uvs;
  mesh.flip_ng = reverse != (t.determinant3() < 0);
  return mesh;
}

// The vertices of a mesh without rounding; its normals and texture coordinates are moved there.
template <class M>
MeshData in_space(const MeshData& data, const Transform& t, M& placed) {
  MeshData mesh{{}, std::move(placed.normals), std::move(placed.uvs), {}};
  for (const Point3d& p : data.positions) mesh.positions.push_back(t.point(p));
  return mesh;
}

template <class M>
void take_vertices(M& mesh, MeshData&& from) {
  mesh.positions = rounded(from.positions, Transform());
  mesh.normals = std::move(from.normals);
  mesh.uvs = std::move(from.uvs);
}

}  // namespace

Mesh place_mesh(const MeshData& data, const Transform& to_space, bool reverse_orientation, Point3d viewer) {
  Mesh mesh = place_vertices<Mesh>(data, to_space, reverse_orientation);
  mesh.triangles = data.triangles;
  mesh.motion_steps = data.motion_steps;
  if (mesh.motion_steps > 1 || !has_coarse_triangles(mesh, viewer)) return mesh;
  MeshData cut = in_space(data, to_space, mesh);
  cut.triangles = std::move(mesh.triangles);
  cut_coarse_triangles(cut, mesh.flip_ng, viewer);
  mesh.triangles = std::move(cut.triangles);
  take_vertices(mesh, std::move(cut));
  return mesh;
}

PatchMesh place_patches(const PatchData& data, const Transform& to_space, bool reverse_orientation, Point3d viewer) {
  PatchMesh mesh = place_vertices<PatchMesh>(data.vertices, to_space, reverse_orientation);
  mesh.patches = data.patches;
  MeshData cut = in_space(data.vertices, to_space, mesh);
  cut_coarse_patches(cut, mesh.patches, viewer);
  take_vertices(mesh, std::move(cut));
  return mesh;
}

}  // namespace etd
