#include "shapes/mesh_shapes.h"

#include <fmt/format.h>

#include "io/obj.h"
#include "shapes/alpha.h"

namespace etd {

const ModelDecl& trianglemesh_decl() {
  static const ModelDecl d{
      Family::kShape,
      "trianglemesh",
      "Triangles over shared vertices.",
      {{.name = "P", .type = ParamType::kPoint3, .required = true, .array = true, .unit = "m", .doc = "Vertices."},
       {.name = "indices",
        .type = ParamType::kInteger,
        .array = true,
        .doc = "Three vertices per triangle, from 0; may be left out for a single triangle."},
       {.name = "N", .type = ParamType::kNormal, .array = true, .doc = "A shading normal per vertex."},
       {.name = "uv", .type = ParamType::kPoint2, .array = true, .doc = "Texture coordinates per vertex."},
       alpha_param()}};
  return d;
}

namespace {

ParamDecl file_param() {
  return {.name = "filename",
          .type = ParamType::kString,
          .required = true,
          .doc = "The file, relative to the scene's folder; may be compressed with gzip."};
}

}  // namespace

const ModelDecl& plymesh_decl() {
  static const ModelDecl d{Family::kShape,
                           "plymesh",
                           "A mesh from a PLY file: ascii or binary, polygons of any size, normals, uv.",
                           {file_param(), alpha_param()}};
  return d;
}

const ModelDecl& offmesh_decl() {
  static const ModelDecl d{Family::kShape,
                           "offmesh",
                           "A mesh from an OFF file: polygons of any size, normals, uv. Not in pbrt-v4.",
                           {file_param(), alpha_param()}};
  return d;
}

const ModelDecl& objmesh_decl() {
  static const ModelDecl d{
      Family::kShape,
      "objmesh",
      "A mesh from a Wavefront OBJ file: polygons of any size, normals, uv, materials. Not in pbrt-v4.",
      {file_param(),
       {.name = "materials",
        .type = ParamType::kBool,
        .default_value = true,
        .doc = "Give faces the materials of the file's MTL; those that it does not name have the current one."},
       alpha_param()}};
  return d;
}

std::optional<MeshData> make_trianglemesh(const ParamReader& p) {
  Diagnostics& diagnostics = p.diagnostics();
  const int errors = diagnostics.error_count();
  const std::vector<double> positions = p.numbers("P"), normals = p.numbers("N"), uvs = p.numbers("uv");
  std::vector<int32_t> indices = p.integers("indices");
  if (positions.empty()) return {};  // reported as missing
  const size_t vertices = positions.size() / 3;
  const auto check_count = [&](const char* name, size_t given) {
    if (given == 0 || given == vertices) return;
    diagnostics.error(p.given(name)->value_loc,
                      fmt::format("\"{}\" has values for {} vertices, but \"P\" has {}", name, given, vertices));
  };
  check_count("N", normals.size() / 3);
  check_count("uv", uvs.size() / 2);
  if (!p.given("indices")) {
    if (vertices == 3)
      indices = {0, 1, 2};
    else
      diagnostics.error(p.use().loc, "a trianglemesh of more than one triangle needs \"integer indices\"");
  }
  if (indices.size() % 3 != 0)
    diagnostics.error(p.given("indices")->value_loc,
                      fmt::format("\"indices\" has {} values, which is not a multiple of 3", indices.size()));
  size_t outside = 0, first = 0;
  for (size_t i = 0; i < indices.size(); ++i)
    if (indices[i] < 0 || static_cast<size_t>(indices[i]) >= vertices)
      if (outside++ == 0) first = i;
  if (outside > 0)
    diagnostics.error(p.given("indices")->value_loc,
                      fmt::format("\"indices\" value {} (number {}) is not a vertex{}", indices[first], first + 1,
                                  outside > 1 ? fmt::format(", and {} more", outside - 1) : ""),
                      fmt::format("valid: 0 to {}", vertices - 1));
  if (diagnostics.error_count() > errors) return {};

  MeshData mesh;
  for (size_t i = 0; i < vertices; ++i)
    mesh.positions.push_back({positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]});
  for (size_t i = 0; i + 2 < normals.size(); i += 3)
    mesh.normals.push_back(to_float(Vec3d{normals[i], normals[i + 1], normals[i + 2]}));
  for (size_t i = 0; i + 1 < uvs.size(); i += 2)
    mesh.uvs.push_back({static_cast<float>(uvs[i]), static_cast<float>(uvs[i + 1])});
  for (size_t i = 0; i + 2 < indices.size(); i += 3)
    mesh.triangles.push_back({static_cast<uint32_t>(indices[i]), static_cast<uint32_t>(indices[i + 1]),
                              static_cast<uint32_t>(indices[i + 2])});
  return mesh;
}

void report_mesh_problems(std::span<const std::string> problems, std::span<const std::string> notes, SourceLoc loc,
                          const std::string& name, Diagnostics& diagnostics) {
  for (const std::string& problem : problems) diagnostics.error(loc, fmt::format("{}: {}", name, problem));
  for (const std::string& note : notes) diagnostics.note(loc, fmt::format("{}: {}", name, note));
}

std::optional<MeshData> make_mesh_from_file(const ParamReader& p, const std::filesystem::path& folder) {
  const Param* file = p.given("filename");
  if (!file) return {};
  const std::filesystem::path path = folder / file->strings[0];
  const std::string& model = p.decl().name;
  MeshResult result = model == "plymesh" ? read_ply(path) : model == "offmesh" ? read_off(path) : read_obj_mesh(path);
  report_mesh_problems(result.problems, result.notes, file->value_loc, file->strings[0], p.diagnostics());
  return std::move(result.mesh);
}

}  // namespace etd
