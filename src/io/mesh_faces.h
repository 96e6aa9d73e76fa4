// What the readers of mesh files have in common once they know vertices and faces: triangles, and an account of what
// cannot be drawn. Programs leave faces of two corners and unused vertices in their files, which are no reason to stop.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/mesh.h"
#include "io/problem_list.h"

namespace etd {

// What is wrong with a face of too many corners.
std::string too_many_corners(const Limits& limits);

// What was left out of a mesh, or is drawn in another way than the file says.
struct MeshLosses {
  size_t small_faces = 0;  // of fewer than three different corners
  size_t unused_vertices = 0;
  size_t normals = 0, uvs = 0;  // that are not finite
  size_t crossing_faces = 0;
  Point3d crossing_at;  // a corner of the first of them

  // One note on what was left out, and one on faces that cross themselves.
  void add_notes(std::vector<std::string>& notes) const;
};

// The normal as a mesh has it: zero, which stands for that of the face, if it is not finite.
Vec3 finite_normal(Vec3 n, MeshLosses& losses);
// The texture coordinates, (0, 0) if they are not finite.
Vec2 finite_uv(Vec2 uv, MeshLosses& losses);

// The faces of a mesh in the order of its file, before the positions of their corners need to be known.
class FaceList {
 public:
  void reserve(size_t faces) { triangles_.reserve(faces); }
  // A polygon, without corners that repeat the one before them and edges that run back on themselves.
  void add(std::span<const uint32_t> corners, MeshLosses& losses);
  void add_triangle(uint32_t a, uint32_t b, uint32_t c) { triangles_.push_back({a, b, c}); }
  bool empty() const { return triangles_.empty(); }
  // Calls f with every corner of every face, some of them more than once.
  template <class F>
  void for_each_corner(const F& f) const {
    for (const auto& triangle : triangles_)
      for (const uint32_t corner : triangle) f(corner);
  }
  // Takes the faces as triangles. The positions of all corners are finite.
  std::vector<std::array<uint32_t, 3>> take_triangles(const std::vector<Point3d>& positions, MeshLosses& losses);

 private:
  struct Polygon {
    size_t first;      // of its triangles: until they are cut, a fan around its first corner
    uint32_t corners;  // more than three
  };
  std::vector<std::array<uint32_t, 3>> triangles_;
  std::vector<Polygon> polygons_;
  std::vector<uint32_t> scratch_;
};

// Vertices of a file whose positions are not finite floats, which only those that a face uses may not have.
class UnfitPositions {
 public:
  // `line` is 0 in a binary file.
  void check(Point3d p, uint32_t vertex, int line);
  // A problem for each that is used; `first` is the number by which the file calls vertex 0.
  void report(const std::vector<Point3d>& positions, const std::vector<bool>& used, uint32_t first,
              ProblemList& problems) const;

 private:
  struct Place {
    uint32_t vertex;
    int line;
  };
  std::vector<Place> places_;
};

// Leaves out the vertices that no triangle uses, and returns their number.
size_t drop_unused_vertices(MeshData& mesh);

// Completes a mesh of all vertices of a file with its faces: triangles, and only vertices that they use. When there are
// problems already, it only adds those of positions.
void finish_mesh(MeshData& mesh, FaceList& faces, const UnfitPositions& unfit, MeshLosses& losses,
                 ProblemList& problems);

constexpr const char* kNoFaces = "the mesh has no faces of at least 3 different vertices";

}  // namespace etd
