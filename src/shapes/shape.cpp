// The list of shapes. To add one: its declaration, its line in make_shape.
#include "shapes/shape.h"

#include <fmt/format.h>

namespace etd {

namespace {

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
       {.name = "uv", .type = ParamType::kPoint2, .array = true, .doc = "Texture coordinates per vertex."}}};
  return d;
}

const ModelDecl& plymesh_decl() {
  static const ModelDecl d{Family::kShape,
                           "plymesh",
                           "A mesh from a PLY file: ascii or binary, polygons of any size, normals, uv.",
                           {{.name = "filename",
                             .type = ParamType::kString,
                             .required = true,
                             .doc = "The file, relative to the scene's folder."}}};
  return d;
}

const ModelDecl& sphere_decl() {
  static const ModelDecl d{
      Family::kShape,
      "sphere",
      "A full sphere around the origin.",
      {{.name = "radius", .default_value = 1.0, .min = 0, .above_min = true, .unit = "m", .doc = "Radius."}}};
  return d;
}

std::optional<ShapeGeometry> trianglemesh(const ParamReader& p) {
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
  return ShapeGeometry{std::move(mesh), 0.0};
}

std::optional<ShapeGeometry> plymesh(const ParamReader& p, const std::filesystem::path& folder) {
  const Param* file = p.given("filename");
  if (!file) return {};
  MeshResult result = read_ply(folder / file->strings[0]);
  for (const std::string& problem : result.problems)
    p.diagnostics().error(file->value_loc, fmt::format("{}: {}", file->strings[0], problem));
  for (const std::string& note : result.notes)
    p.diagnostics().note(file->value_loc, fmt::format("{}: {}", file->strings[0], note));
  if (!result.mesh) return {};
  return ShapeGeometry{std::move(result.mesh), 0.0};
}

}  // namespace

std::span<const ModelDecl* const> shape_models() {
  static const ModelDecl* const all[] = {&trianglemesh_decl(), &plymesh_decl(), &sphere_decl()};
  return all;
}

std::optional<ShapeGeometry> make_shape(const ModelUse& use, const std::filesystem::path& folder,
                                        Diagnostics& diagnostics) {
  if (use.model == "trianglemesh") return trianglemesh({trianglemesh_decl(), use, diagnostics});
  if (use.model == "plymesh") return plymesh({plymesh_decl(), use, diagnostics}, folder);
  if (use.model == "sphere") {
    const ParamReader p(sphere_decl(), use, diagnostics);
    return ShapeGeometry{{}, p.number("radius")};
  }
  return {};
}

}  // namespace etd
