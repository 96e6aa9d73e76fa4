#include "shapes/cut_patches.h"

#include "shapes/cut_triangles.h"

namespace etd {
namespace {

using Patch = std::array<uint32_t, 4>;

constexpr int kMostCuts = 40;

bool is_coarse(const MeshData& mesh, const Patch& patch, Point3d viewer) {
  const auto p = [&](size_t i) { return mesh.positions[patch[i]]; };
  // A patch lies within the tetrahedron of its corners.
  for (const auto& [a, b, c] : {std::array<size_t, 3>{0, 1, 2}, std::array<size_t, 3>{1, 2, 3},
                                std::array<size_t, 3>{0, 1, 3}, std::array<size_t, 3>{0, 2, 3}})
    if (is_coarse_triangle(p(a), p(b), p(c), viewer)) return true;
  return false;
}

// Patches without texture coordinates have their u and v, which pieces must not begin again.
void give_uvs(MeshData& mesh, std::vector<Patch>& patches) {
  MeshData own;
  for (Patch& patch : patches) {
    for (uint32_t& v : patch) {
      own.positions.push_back(mesh.positions[v]);
      if (!mesh.normals.empty()) own.normals.push_back(mesh.normals[v]);
      v = static_cast<uint32_t>(own.positions.size() - 1);
    }
    own.uvs.insert(own.uvs.end(), {{0, 0}, {1, 0}, {0, 1}, {1, 1}});
  }
  mesh = std::move(own);
}

uint32_t middle(MeshData& mesh, uint32_t a, uint32_t b) {
  const Point3d p = mesh.positions[a], q = mesh.positions[b];
  mesh.positions.push_back({0.5 * (p.x + q.x), 0.5 * (p.y + q.y), 0.5 * (p.z + q.z)});
  if (!mesh.normals.empty()) mesh.normals.push_back((mesh.normals[a] + mesh.normals[b]) * 0.5f);
  const Vec2 s = mesh.uvs[a], t = mesh.uvs[b];
  mesh.uvs.push_back({0.5f * (s.x + t.x), 0.5f * (s.y + t.y)});
  return static_cast<uint32_t>(mesh.positions.size() - 1);
}

}  // namespace

void cut_coarse_patches(MeshData& vertices, std::vector<Patch>& patches, Point3d viewer) {
  std::vector<int> cuts(patches.size(), 0);
  for (size_t i = 0; i < patches.size();) {
    if (cuts[i] == kMostCuts || !is_coarse(vertices, patches[i], viewer)) {
      ++i;
      continue;
    }
    if (vertices.uvs.empty()) give_uvs(vertices, patches);
    const Patch p = patches[i];
    const uint32_t low = middle(vertices, p[0], p[1]), high = middle(vertices, p[2], p[3]);
    const uint32_t left = middle(vertices, p[0], p[2]), right = middle(vertices, p[1], p[3]);
    const uint32_t centre = middle(vertices, low, high);
    patches[i] = {p[0], low, left, centre};
    patches.insert(patches.end(),
                   {{low, p[1], centre, right}, {left, centre, p[2], high}, {centre, right, high, p[3]}});
    ++cuts[i];
    cuts.insert(cuts.end(), 3, cuts[i]);
  }
}

}  // namespace etd
