// Shapes that are meshes: given in the scene, or in a file of one of three kinds.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "io/mesh.h"
#include "params/declaration.h"

namespace etd {

const ModelDecl& trianglemesh_decl();
const ModelDecl& read_mesh_decl();  // a trianglemesh whose vertices a reader has taken from a file already
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
std::shared_ptr<const MeshData> without_unused_vertices(MeshData mesh);

// The meshes of files, each of which is read once however many shapes name it.
class MeshFiles {
 public:
  // The mesh of the file that "filename" names, in the format of the model; null when it can't be read. What is wrong
  // with a file and what is left out of it is reported for the first shape that names it.
  std::shared_ptr<const MeshData> mesh(const ParamReader& p, const std::filesystem::path& folder);

 private:
  std::map<std::pair<std::string, std::string>, std::shared_ptr<const MeshData>> meshes_;  // by model and place
};

// Reports what a mesh file is wrong about at the place that names it; `name` is the file's, seen from `folder`.
void report_mesh_problems(std::span<const std::string> problems, std::span<const std::string> notes, SourceLoc loc,
                          const std::filesystem::path& folder, const std::string& name, Diagnostics& diagnostics);

}  // namespace etd
