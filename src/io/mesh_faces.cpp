#include "io/mesh_faces.h"

#include <algorithm>
#include <cmath>

#include "io/polygon.h"

namespace etd {

namespace {

std::string counted(size_t count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

}  // namespace

std::string too_many_corners(const Limits& limits) {
  return fmt::format("a face of too many corners; {}", limit_text(limits, &Limits::corners));
}

void MeshLosses::add_notes(std::vector<std::string>& notes) const {
  std::vector<std::string> parts;
  const auto part = [&parts](size_t count, std::string_view one, std::string_view many) {
    if (count > 0) parts.push_back(counted(count, one, many));
  };
  part(small_faces, "face of fewer than 3 different vertices", "faces of fewer than 3 different vertices");
  part(unused_vertices, "vertex that no face uses", "vertices that no face uses");
  part(normals, "normal that is not finite", "normals that are not finite");
  part(uvs, "pair of texture coordinates that are not finite", "pairs of texture coordinates that are not finite");
  if (!parts.empty()) notes.push_back(fmt::format("left out: {}", fmt::join(parts, ", ")));
  if (crossing_faces > 0)
    notes.push_back(fmt::format("{}, and may be drawn wrongly; the first begins at ({}, {}, {})",
                                counted(crossing_faces, "face crosses itself", "faces cross themselves"), crossing_at.x,
                                crossing_at.y, crossing_at.z));
}

Vec3 finite_normal(Vec3 n, MeshLosses& losses) {
  if (is_finite(n)) return n;
  ++losses.normals;
  return {};
}

Vec2 finite_uv(Vec2 uv, MeshLosses& losses) {
  if (std::isfinite(uv.x) && std::isfinite(uv.y)) return uv;
  ++losses.uvs;
  return {};
}

void FaceList::add(std::span<const uint32_t> corners, MeshLosses& losses) {
  const auto is_triangle = [](auto c) { return c[0] != c[1] && c[1] != c[2] && c[2] != c[0]; };
  if (corners.size() == 3 && is_triangle(corners)) return add_triangle(corners[0], corners[1], corners[2]);
  std::vector<uint32_t>& face = scratch_;
  face.clear();
  for (const uint32_t c : corners) {
    if (!face.empty() && face.back() == c) continue;
    if (face.size() > 1 && face[face.size() - 2] == c)
      face.pop_back();
    else
      face.push_back(c);
  }
  // The same where the end meets the beginning.
  size_t begin = 0;
  const auto left = [&] { return face.size() - begin; };
  while (left() > 1) {
    if (face.back() == face[begin])
      face.pop_back();
    else if (left() > 2 && face[face.size() - 2] == face[begin])
      face.pop_back();
    else if (left() > 2 && face.back() == face[begin + 1])
      ++begin;
    else
      break;
  }
  if (left() < 3) {
    ++losses.small_faces;
    return;
  }
  if (left() > 3) polygons_.push_back({triangles_.size(), static_cast<uint32_t>(left())});
  for (size_t i = begin + 2; i < face.size(); ++i) triangles_.push_back({face[begin], face[i - 1], face[i]});
}

std::vector<std::array<uint32_t, 3>> FaceList::take_triangles(const std::vector<Point3d>& positions,
                                                              MeshLosses& losses) {
  if (polygons_.empty()) return std::move(triangles_);
  PolygonCutter cutter;
  std::vector<std::array<uint32_t, 3>> cut;
  size_t from = 0, to = 0;
  const auto keep_until = [&](size_t end) {
    while (from < end) triangles_[to++] = triangles_[from++];
  };
  for (const Polygon& polygon : polygons_) {
    keep_until(polygon.first);
    scratch_.assign({triangles_[from][0], triangles_[from][1]});
    for (uint32_t i = 2; i < polygon.corners; ++i) scratch_.push_back(triangles_[from++][2]);
    cut.clear();
    if (!cutter.cut(positions, scratch_, cut) && losses.crossing_faces++ == 0)
      losses.crossing_at = positions[scratch_[0]];
    for (const auto& triangle : cut) triangles_[to++] = triangle;
  }
  keep_until(triangles_.size());
  triangles_.resize(to);
  polygons_.clear();
  return std::move(triangles_);
}

void UnfitPositions::check(Point3d p, uint32_t vertex, int line) {
  if (!is_finite(to_float(p - Point3d()))) places_.push_back({vertex, line});
}

void UnfitPositions::report(const std::vector<Point3d>& positions, const std::vector<bool>& used, uint32_t first,
                            ProblemList& problems) const {
  for (const Place& place : places_) {
    if (!used[place.vertex]) continue;
    const Point3d p = positions[place.vertex];
    int axis = 0;
    while (std::isfinite(static_cast<float>(p[axis]))) ++axis;
    problems.add(fmt::format("{}vertex {}: {} is {}, not a finite number",
                             place.line > 0 ? fmt::format("line {}: ", place.line) : "", place.vertex + first,
                             "xyz"[axis], p[axis]));
  }
}

size_t drop_unused_vertices(MeshData& mesh) {
  const size_t steps = mesh.motion_steps, count = mesh.positions.size() / steps;
  std::vector<uint32_t> place(count, 0);  // 1 for those in use, then where they go
  for (const auto& triangle : mesh.triangles)
    for (const uint32_t corner : triangle) place[corner] = 1;
  const auto used = static_cast<size_t>(std::count(place.begin(), place.end(), 1u));
  if (used == count) return 0;
  const auto keep = [&](auto& values) {
    size_t to = 0;
    for (size_t i = 0; i < values.size(); ++i)
      if (place[i % count] == 1) values[to++] = values[i];
    values.resize(to);
  };
  keep(mesh.positions);
  keep(mesh.normals);
  keep(mesh.uvs);
  uint32_t next = 0;
  for (uint32_t& p : place) p = p == 1 ? next++ : 0;
  for (auto& triangle : mesh.triangles)
    for (uint32_t& corner : triangle) corner = place[corner];
  return count - used;
}

void finish_mesh(MeshData& mesh, FaceList& faces, const UnfitPositions& unfit, MeshLosses& losses,
                 ProblemList& problems) {
  std::vector<bool> used(mesh.positions.size());
  faces.for_each_corner([&used](uint32_t corner) { used[corner] = true; });
  unfit.report(mesh.positions, used, 0, problems);
  if (!problems.empty()) return;
  mesh.triangles = faces.take_triangles(mesh.positions, losses);
  if (mesh.triangles.empty()) return problems.add(kNoFaces);
  losses.unused_vertices += drop_unused_vertices(mesh);
}

}  // namespace etd
