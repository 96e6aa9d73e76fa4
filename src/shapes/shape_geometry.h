// What a shape is before its transform, and what shapes are made from.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "io/mesh.h"
#include "shapes/quadric.h"

namespace etd {

// Bilinear patches over vertices; the triangles of `vertices` are unused.
struct PatchData {
  MeshData vertices;
  std::vector<std::array<uint32_t, 4>> patches;
};

struct QuadricShape {
  Transform unit_to_object;
  QuadricPart part;
};

// One of these; none when there were problems.
struct ShapeGeometry {
  std::shared_ptr<const MeshData> mesh = {};  // that of a file is the same for all shapes that name it
  std::optional<PatchData> patches = {};
  std::optional<QuadricShape> quadric = {};
};

class MeshFiles;

struct ShapeContext {
  std::filesystem::path folder;  // that relative file names start from
  MeshFiles& files;              // what has been read of them
};

}  // namespace etd
