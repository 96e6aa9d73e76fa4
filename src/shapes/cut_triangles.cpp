#include "shapes/cut_triangles.h"

#include <set>
#include <utility>

namespace etd {
namespace {

constexpr int kMostCuts = 40;

double length2(Vec3d v) { return dot(v, v); }

double longest2(Point3d a, Point3d b, Point3d c) {
  return std::max(length2(b - a), std::max(length2(c - b), length2(a - c)));
}

double distance_to_segment(Point3d p, Point3d a, Point3d b) {
  const Vec3d along = b - a;
  const double l2 = length2(along), t = l2 > 0 ? std::clamp(dot(p - a, along) / l2, 0.0, 1.0) : 0.0;
  return length(a + along * t - p);
}

using Place = std::array<double, 3>;
using Edge = std::pair<Place, Place>;

Place place(Point3d p) { return {p.x, p.y, p.z}; }

// An edge is known by its ends, in either direction: neighbours need not share vertices.
Edge edge_of(Point3d a, Point3d b) {
  const Place pa = place(a), pb = place(b);
  return pa < pb ? Edge{pa, pb} : Edge{pb, pa};
}

class Cutter {
 public:
  Cutter(MeshData& mesh, bool flip_ng, Point3d viewer) : mesh_(mesh), flip_ng_(flip_ng), viewer_(viewer) {}

  void run() {
    for (int i = 0; i < kMostCuts && mark(); ++i) {
      if (mesh_.uvs.empty()) give_uvs();
      const size_t count = mesh_.triangles.size();
      for (size_t t = 0; t < count; ++t) cut(t);
    }
  }

 private:
  Point3d at(uint32_t vertex) const { return mesh_.positions[vertex]; }

  // The corners of a triangle without texture coordinates have (0, 0), (1, 0), (1, 1), which pieces must not begin
  // again.
  void give_uvs() {
    MeshData own;
    for (auto& triangle : mesh_.triangles) {
      for (uint32_t& v : triangle) {
        own.positions.push_back(mesh_.positions[v]);
        if (!mesh_.normals.empty()) own.normals.push_back(mesh_.normals[v]);
        v = static_cast<uint32_t>(own.positions.size() - 1);
      }
      own.uvs.insert(own.uvs.end(), {{0, 0}, {1, 0}, {1, 1}});
    }
    own.triangles = std::move(mesh_.triangles);
    mesh_ = std::move(own);
  }

  // The edges of all triangles that are too long; false if there are none.
  bool mark() {
    marked_.clear();
    shortest_marked2_ = std::numeric_limits<double>::infinity();
    for (const auto& t : mesh_.triangles) {
      if (!is_coarse_triangle(at(t[0]), at(t[1]), at(t[2]), viewer_, kLongestEdge)) continue;
      for (size_t i = 0; i < 3; ++i) {
        const Point3d a = at(t[i]), b = at(t[(i + 1) % 3]);
        marked_.insert(edge_of(a, b));
        shortest_marked2_ = std::min(shortest_marked2_, length2(b - a));
      }
    }
    return !marked_.empty();
  }

  void cut(size_t triangle) {
    const std::array<uint32_t, 3> t = mesh_.triangles[triangle];
    if (longest2(at(t[0]), at(t[1]), at(t[2])) < shortest_marked2_) return;
    std::array<bool, 3> is_cut;  // the edge from this corner to the next
    for (size_t i = 0; i < 3; ++i) is_cut[i] = marked_.count(edge_of(at(t[i]), at(t[(i + 1) % 3]))) > 0;
    const int cuts = is_cut[0] + is_cut[1] + is_cut[2];
    if (cuts == 0) return;
    // Turned so that the first edge is cut and, of two, the second as well.
    size_t first = 0;
    while (!is_cut[first] || (cuts == 2 && !is_cut[(first + 1) % 3])) ++first;
    const uint32_t a = t[first], b = t[(first + 1) % 3], c = t[(first + 2) % 3];
    const Vec3 face = face_normal(t);
    const uint32_t ab = middle(a, b, face);
    if (cuts == 1) return set(triangle, {{{a, ab, c}, {ab, b, c}}});
    const uint32_t bc = middle(b, c, face);
    if (cuts == 2) return set(triangle, {{{ab, b, bc}, {a, ab, bc}, {a, bc, c}}});
    const uint32_t ca = middle(c, a, face);
    set(triangle, {{{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}});
  }

  void set(size_t triangle, const std::vector<std::array<uint32_t, 3>>& pieces) {
    mesh_.triangles[triangle] = pieces[0];
    mesh_.triangles.insert(mesh_.triangles.end(), pieces.begin() + 1, pieces.end());
  }

  Vec3 face_normal(const std::array<uint32_t, 3>& t) const {
    const Vec3d n = cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0]));
    const double l = length(n);
    return l > 0 ? to_float(n * ((flip_ng_ ? -1.0 : 1.0) / l)) : Vec3{};
  }

  // A new vertex in the middle of an edge: at the same place whichever triangle asks.
  uint32_t middle(uint32_t a, uint32_t b, Vec3 face) {
    const Point3d p = at(a), q = at(b);
    mesh_.positions.push_back({0.5 * (p.x + q.x), 0.5 * (p.y + q.y), 0.5 * (p.z + q.z)});
    if (!mesh_.normals.empty()) {
      const auto normal = [&](uint32_t v) { return mesh_.normals[v] == Vec3{} ? face : mesh_.normals[v]; };
      mesh_.normals.push_back((normal(a) + normal(b)) * 0.5f);
    }
    const Vec2 s = mesh_.uvs[a], t = mesh_.uvs[b];
    mesh_.uvs.push_back({0.5f * (s.x + t.x), 0.5f * (s.y + t.y)});
    return static_cast<uint32_t>(mesh_.positions.size() - 1);
  }

  MeshData& mesh_;
  const bool flip_ng_;
  const Point3d viewer_;
  std::set<Edge> marked_;
  double shortest_marked2_ = 0;
};

}  // namespace

// The foot of the perpendicular if it is inside, which three signed areas tell, otherwise the nearest edge.
double distance_to_triangle(Point3d p, Point3d a, Point3d b, Point3d c) {
  const Vec3d n = cross(b - a, c - a);
  const double n2 = length2(n);
  if (n2 > 0 && dot(cross(b - a, p - a), n) >= 0 && dot(cross(c - b, p - b), n) >= 0 &&
      dot(cross(a - c, p - c), n) >= 0)
    return std::abs(dot(p - a, n)) / std::sqrt(n2);
  return std::min(distance_to_segment(p, a, b), std::min(distance_to_segment(p, b, c), distance_to_segment(p, c, a)));
}

bool is_coarse_triangle(Point3d a, Point3d b, Point3d c, Point3d viewer, double ratio) {
  const double longest = longest2(a, b, c);
  // No point is further from `a` than the longest edge: most triangles need no more than this.
  if (length2(a - viewer) > 1.1 * longest * sqr(1 + 1 / ratio)) return false;
  // From within its plane nothing is seen of it.
  const Vec3d n = cross(b - a, c - a);
  if (!(sqr(dot(viewer - a, n)) > 0x1p-80 * longest * length2(n))) return false;
  return longest > sqr(ratio * distance_to_triangle(viewer, a, b, c));
}

bool has_coarse_triangles(const Mesh& mesh, Point3d viewer, double ratio) {
  for (size_t step = 0; step < mesh.motion_steps; ++step) {
    const Point3* p = mesh.positions.data() + step * mesh.vertex_count();
    for (const auto& t : mesh.triangles)
      if (is_coarse_triangle(to_double(p[t[0]]), to_double(p[t[1]]), to_double(p[t[2]]), viewer, ratio)) return true;
  }
  return false;
}

void cut_coarse_triangles(MeshData& mesh, bool flip_ng, Point3d viewer) { Cutter(mesh, flip_ng, viewer).run(); }

}  // namespace etd
