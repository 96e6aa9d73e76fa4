// A triangle mesh as a file gives it, before any transform.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/vec.h"
#include "params/limits.h"

namespace etd {

struct MeshData {
  std::vector<Point3d> positions;
  std::vector<Vec3> normals;  // empty or one per vertex; not normalised
  std::vector<Vec2> uvs;      // empty or one per vertex
  std::vector<std::array<uint32_t, 3>> triangles;
  // Positions and normals hold the vertices of so many moments, one after the other.
  uint32_t motion_steps = 1;
};

// Leaves out the vertices that are no corner of any face: they would count where the mesh is measured. `corners` are
// the indices of all faces, which are renumbered.
void drop_unused_vertices(MeshData& mesh, std::span<uint32_t> corners);

// The corners of faces of N each.
template <size_t N>
std::span<uint32_t> corners_of(std::vector<std::array<uint32_t, N>>& faces) {
  return {faces.empty() ? nullptr : faces[0].data(), N * faces.size()};
}

// What reading a mesh file gave: the mesh, or every problem found ("line 12: vertex index 99 is out of range ...").
struct MeshResult {
  std::optional<MeshData> mesh;
  std::vector<std::string> problems;  // errors; the mesh is absent when there are any
  std::vector<std::string> notes;     // things left out that may surprise ("vertex colours are not used")
};

// All readers take gzip-compressed files too, skip a byte-order mark, cut polygons into triangles (io/polygon.h) and
// leave out with a note what cannot be drawn (io/mesh_faces.h).

// PLY: ascii, binary_little_endian and binary_big_endian, any property types and extra elements; faces and triangle
// strips.
// Normals nx ny nz; texture coordinates u v, s t, texture_u texture_v or texture_s texture_t.
MeshResult read_ply(const std::filesystem::path& path, const Limits& limits = {});

// OFF as text: headers OFF, COFF, NOFF, STOFF, 4OFF and their combinations, or none. Colours are read over with a note.
MeshResult read_off(const std::filesystem::path& path, const Limits& limits = {});

}  // namespace etd
