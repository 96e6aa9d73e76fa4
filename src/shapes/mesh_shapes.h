// Shapes that are meshes: given in the scene, or in a file of one of three kinds.
#pragma once

#include <filesystem>
#include <optional>

#include "io/mesh.h"
#include "params/declaration.h"

namespace etd {

const ModelDecl& trianglemesh_decl();
const ModelDecl& bilinearmesh_decl();
const ModelDecl& plymesh_decl();
const ModelDecl& offmesh_decl();
const ModelDecl& objmesh_decl();

// Bilinear patches over vertices; the triangles of `vertices` are unused.
struct PatchData {
  MeshData vertices;
  std::vector<std::array<uint32_t, 4>> patches;
};

// Both take checked uses; nothing comes back when there are problems, which are reported.
std::optional<MeshData> make_trianglemesh(const ParamReader& p);
std::optional<PatchData> make_bilinearmesh(const ParamReader& p);
// The same surface as two triangles for each patch, if all are parallelograms with texture coordinates to match and one
// normal each.
std::optional<MeshData> as_triangles(const PatchData& data);
// The mesh of the file that "filename" names, in the format of the model.
std::optional<MeshData> make_mesh_from_file(const ParamReader& p, const std::filesystem::path& folder);

// Reports what a mesh file is wrong about at the place that names it; `name` is the file's, seen from `folder`.
void report_mesh_problems(std::span<const std::string> problems, std::span<const std::string> notes, SourceLoc loc,
                          const std::filesystem::path& folder, const std::string& name, Diagnostics& diagnostics);

}  // namespace etd
