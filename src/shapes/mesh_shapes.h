// Shapes that are meshes: given in the scene, or in a file of one of three kinds.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/loading.h"
#include "io/mesh.h"
#include "params/declaration.h"
#include "shapes/shape_geometry.h"

namespace etd {

struct TriangleMeshShape {
  static const ModelDecl& decl();
  static ShapeGeometry create(const ParamReader& p, const ShapeContext& context);
};
struct BilinearMeshShape {
  static const ModelDecl& decl();
  static ShapeGeometry create(const ParamReader& p, const ShapeContext& context);
};
struct PlyMeshShape {
  static const ModelDecl& decl();
  static ShapeGeometry create(const ParamReader& p, const ShapeContext& context);
};
struct OffMeshShape {
  static const ModelDecl& decl();
  static ShapeGeometry create(const ParamReader& p, const ShapeContext& context);
};
struct ObjMeshShape {
  static const ModelDecl& decl();
  static ShapeGeometry create(const ParamReader& p, const ShapeContext& context);
};

// A trianglemesh whose vertices a reader has taken from a file already.
const ModelDecl& read_mesh_decl();

// The same surface as two triangles for each patch, if all are parallelograms with texture coordinates to match and one
// normal each.
std::optional<MeshData> as_triangles(const PatchData& data);
std::shared_ptr<const MeshData> without_unused_vertices(MeshData mesh);

// The meshes of files, each of which is read once however many shapes name it.
class MeshFiles {
 public:
  // Reads the files that these shapes name, those of them that are meshes of files, on all threads. It reports nothing:
  // mesh() does, so that messages come in the order of shapes. Throws LoadingStopped when the monitor says so.
  void read(std::span<const ModelUse* const> uses, const std::filesystem::path& folder, const Limits& limits,
            const LoadMonitor& monitor);
  // The mesh of the file that "filename" names, read now or before; null when it can't be read. What is wrong with a
  // file and what is left out of it is reported for the first shape that names it.
  std::shared_ptr<const MeshData> mesh(const ParamReader& p, const std::filesystem::path& folder);

 private:
  struct File {
    void read(std::string_view model, const std::filesystem::path& path, const Limits& limits);

    std::shared_ptr<const MeshData> mesh;
    std::vector<std::string> problems, notes;
    bool is_read = false, is_reported = false;
  };
  // The file of this model, new or known.
  File& find(const std::string& model, const std::filesystem::path& path);

  std::map<std::pair<std::string, std::string>, File> files_;  // by model and place
};

// Reports what a mesh file is wrong about at the place that names it; `name` is the file's, seen from `folder`.
void report_mesh_problems(std::span<const std::string> problems, std::span<const std::string> notes, SourceLoc loc,
                          const std::filesystem::path& folder, const std::string& name, Diagnostics& diagnostics);

}  // namespace etd
