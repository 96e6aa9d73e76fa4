#include "shapes/mesh_shapes.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <array>
#include <atomic>
#include <set>

#include "io/missing_file.h"
#include "io/obj.h"
#include "shapes/alpha.h"

namespace etd {

const ModelDecl& TriangleMeshShape::decl() {
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
       {.name = "motionsteps",
        .type = ParamType::kInteger,
        .default_value = 1,
        .min = 1,
        .max = 129,
        .doc = "P and N hold the vertices of so many moments, one after the other, spread evenly over TransformTimes; "
               "they move straight in between. Not in pbrt-v4."},
       alpha_param()}};
  return d;
}

const ModelDecl& read_mesh_decl() {
  static const ModelDecl d{Family::kShape, "trianglemesh", "Triangles of a file.", {alpha_param()}};
  return d;
}

const ModelDecl& BilinearMeshShape::decl() {
  static const ModelDecl d{
      Family::kShape,
      "bilinearmesh",
      "Bilinear patches over shared vertices, each the surface that two pairs of opposite edges span.",
      {{.name = "P", .type = ParamType::kPoint3, .required = true, .array = true, .unit = "m", .doc = "Vertices."},
       {.name = "indices",
        .type = ParamType::kInteger,
        .array = true,
        .doc = "Four vertices per patch, from 0, at (u, v) = (0, 0), (1, 0), (0, 1), (1, 1); may be left out for a "
               "single patch."},
       {.name = "N", .type = ParamType::kNormal, .array = true, .doc = "A shading normal per vertex."},
       {.name = "uv",
        .type = ParamType::kPoint2,
        .array = true,
        .doc = "Texture coordinates per vertex; otherwise those of each patch."},
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

const ModelDecl& PlyMeshShape::decl() {
  static const ModelDecl d{Family::kShape,
                           "plymesh",
                           "A mesh from a PLY file: ascii or binary, polygons of any size, normals, uv.",
                           {file_param(), alpha_param()}};
  return d;
}

const ModelDecl& OffMeshShape::decl() {
  static const ModelDecl d{Family::kShape,
                           "offmesh",
                           "A mesh from an OFF file: polygons of any size, normals, uv. Not in pbrt-v4.",
                           {file_param(), alpha_param()}};
  return d;
}

const ModelDecl& ObjMeshShape::decl() {
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

namespace {

// What trianglemesh and bilinearmesh have in common: vertices, and indices of faces with so many corners each.
struct IndexedVertices {
  MeshData vertices;
  std::vector<int32_t> indices;
};

void check_indices(const ParamReader& p, size_t corners, size_t vertices, std::vector<int32_t>& indices) {
  Diagnostics& diagnostics = p.diagnostics();
  if (!p.given("indices")) {
    for (size_t i = 0; vertices == corners && i < corners; ++i) indices.push_back(static_cast<int32_t>(i));
    if (vertices != corners)
      diagnostics.error(p.use().loc, fmt::format("a {} of more than one {} needs \"integer indices\"", p.decl().name,
                                                 corners == 3 ? "triangle" : "patch"));
    return;
  }
  if (indices.size() % corners != 0)
    diagnostics.error(p.given("indices")->value_loc,
                      fmt::format("\"indices\" has {} values, which is not a multiple of {}", indices.size(), corners));
  size_t outside = 0, first = 0;
  for (size_t i = 0; i < indices.size(); ++i)
    if (indices[i] < 0 || static_cast<size_t>(indices[i]) >= vertices)
      if (outside++ == 0) first = i;
  if (outside > 0)
    diagnostics.error(p.given("indices")->value_loc,
                      fmt::format("\"indices\" value {} (number {}) is not a vertex{}", indices[first], first + 1,
                                  outside > 1 ? fmt::format(", and {} more", outside - 1) : ""),
                      fmt::format("valid: 0 to {}", vertices - 1));
}

// "P" and "N" hold the vertices of so many motion steps.
std::optional<IndexedVertices> read_indexed(const ParamReader& p, size_t corners, size_t steps = 1) {
  Diagnostics& diagnostics = p.diagnostics();
  const int errors = diagnostics.error_count();
  const std::vector<double> positions = p.numbers("P"), normals = p.numbers("N"), uvs = p.numbers("uv");
  if (positions.empty()) return {};  // reported as missing
  const size_t points = positions.size() / 3, vertices = points / steps;
  if (points % steps != 0) {
    diagnostics.error(p.given("motionsteps")->value_loc,
                      fmt::format("\"P\" has {} vertices, which {} motion steps do not share evenly", points, steps),
                      "every motion step gives all the vertices");
    return {};
  }
  const auto check_count = [&](const char* name, size_t given, size_t expected) {
    if (given == 0 || given == expected) return;
    diagnostics.error(p.given(name)->value_loc,
                      fmt::format("\"{}\" has values for {} vertices, but \"P\" has {}{}", name, given, expected,
                                  expected == points ? "" : " in each motion step"));
  };
  check_count("N", normals.size() / 3, points);
  check_count("uv", uvs.size() / 2, vertices);
  IndexedVertices read{{}, p.integers("indices")};
  check_indices(p, corners, vertices, read.indices);
  if (diagnostics.error_count() > errors) return {};

  MeshData& mesh = read.vertices;
  mesh.motion_steps = static_cast<uint32_t>(steps);
  for (size_t i = 0; i < points; ++i)
    mesh.positions.push_back({positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]});
  for (size_t i = 0; i + 2 < normals.size(); i += 3)
    mesh.normals.push_back(to_float(Vec3d{normals[i], normals[i + 1], normals[i + 2]}));
  for (size_t i = 0; i + 1 < uvs.size(); i += 2)
    mesh.uvs.push_back({static_cast<float>(uvs[i]), static_cast<float>(uvs[i + 1])});
  return read;
}

// The indices in groups of N.
template <size_t N>
std::vector<std::array<uint32_t, N>> in_faces(const std::vector<int32_t>& indices) {
  std::vector<std::array<uint32_t, N>> faces(indices.size() / N);
  for (size_t i = 0; i < N * faces.size(); ++i) faces[i / N][i % N] = static_cast<uint32_t>(indices[i]);
  return faces;
}

using ReadMesh = MeshResult (*)(const std::filesystem::path& path, const Limits& limits);

// Null for models that are no files.
ReadMesh reader_of(std::string_view model) {
  if (model == PlyMeshShape::decl().name) return read_ply;
  if (model == OffMeshShape::decl().name) return read_off;
  if (model == ObjMeshShape::decl().name) return read_obj_mesh;
  return nullptr;
}

}  // namespace

ShapeGeometry TriangleMeshShape::create(const ParamReader& p, const ShapeContext&) {
  std::optional<IndexedVertices> read = read_indexed(p, 3, static_cast<size_t>(p.integer("motionsteps")));
  if (!read) return {};
  read->vertices.triangles = in_faces<3>(read->indices);
  return {.mesh = without_unused_vertices(std::move(read->vertices))};
}

ShapeGeometry BilinearMeshShape::create(const ParamReader& p, const ShapeContext&) {
  std::optional<IndexedVertices> read = read_indexed(p, 4);
  if (!read) return {};
  PatchData data{std::move(read->vertices), in_faces<4>(read->indices)};
  // Parallelograms are two triangles each, and those are met faster.
  if (auto mesh = as_triangles(data)) return {.mesh = without_unused_vertices(std::move(*mesh))};
  drop_unused_vertices(data.vertices, corners_of(data.patches));
  return {.patches = std::move(data)};
}

ShapeGeometry PlyMeshShape::create(const ParamReader& p, const ShapeContext& context) {
  return {.mesh = context.files.mesh(p, context.folder)};
}

ShapeGeometry OffMeshShape::create(const ParamReader& p, const ShapeContext& context) {
  return {.mesh = context.files.mesh(p, context.folder)};
}

ShapeGeometry ObjMeshShape::create(const ParamReader& p, const ShapeContext& context) {
  return {.mesh = context.files.mesh(p, context.folder)};
}

std::optional<MeshData> as_triangles(const PatchData& data) {
  const MeshData& from = data.vertices;
  MeshData mesh;
  for (const auto& patch : data.patches) {
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    const auto corner = [&](size_t i) { return from.positions[patch[i]]; };
    const Vec3d twist = (corner(3) - corner(2)) - (corner(1) - corner(0));
    if (!(length(twist) <= 1e-7 * (length(corner(3) - corner(0)) + length(corner(2) - corner(1))))) return {};
    for (size_t i = 0; i < 4; ++i) {
      mesh.positions.push_back(corner(i));
      if (!from.normals.empty()) {
        if (!(from.normals[patch[i]] == from.normals[patch[0]])) return {};
        mesh.normals.push_back(from.normals[patch[i]]);
      }
      mesh.uvs.push_back(from.uvs.empty() ? Vec2{static_cast<float>(i & 1), static_cast<float>(i >> 1)}
                                          : from.uvs[patch[i]]);
    }
    const Vec2* uv = mesh.uvs.data() + first;
    if (uv[3].x - uv[2].x != uv[1].x - uv[0].x || uv[3].y - uv[2].y != uv[1].y - uv[0].y) return {};
    mesh.triangles.push_back({first, first + 1, first + 3});
    mesh.triangles.push_back({first, first + 3, first + 2});
  }
  return mesh;
}

void report_mesh_problems(std::span<const std::string> problems, std::span<const std::string> notes, SourceLoc loc,
                          const std::filesystem::path& folder, const std::string& name, Diagnostics& diagnostics) {
  for (const std::string& problem : problems)
    diagnostics.error(loc, fmt::format("{}: {}", name, problem), [&] { return missing_file_hint({folder}, name); });
  for (const std::string& note : notes) diagnostics.note(loc, fmt::format("{}: {}", name, note));
}

std::shared_ptr<const MeshData> without_unused_vertices(MeshData mesh) {
  drop_unused_vertices(mesh, corners_of(mesh.triangles));
  return std::make_shared<const MeshData>(std::move(mesh));
}

void MeshFiles::File::read(std::string_view model, const std::filesystem::path& path, const Limits& limits) {
  MeshResult result = reader_of(model)(path, limits);
  if (result.mesh) mesh = without_unused_vertices(std::move(*result.mesh));
  problems = std::move(result.problems);
  notes = std::move(result.notes);
  is_read = true;
}

MeshFiles::File& MeshFiles::find(const std::string& model, const std::filesystem::path& path) {
  std::error_code failed;
  const std::filesystem::path place = std::filesystem::weakly_canonical(path, failed);
  return files_[{model, failed ? path.string() : place.string()}];
}

void MeshFiles::read(std::span<const ModelUse* const> uses, const std::filesystem::path& folder, const Limits& limits,
                     const LoadMonitor& monitor) {
  struct Task {
    File* file;
    const std::string* model;
    std::filesystem::path path;
  };
  std::vector<Task> tasks;
  std::set<const File*> known;
  for (const ModelUse* use : uses) {
    const Param* name = use->find("filename");
    if (!reader_of(use->model) || !name || name->malformed || name->kind != ParamKind::kString ||
        name->strings.size() != 1)
      continue;
    const std::filesystem::path path = folder / name->strings[0];
    File& file = find(use->model, path);
    if (!file.is_read && known.insert(&file).second) tasks.push_back({&file, &use->model, path});
  }
  std::atomic<size_t> begun{0};
  const auto read_one = [&](size_t i) {
    const size_t number = ++begun;
    if (monitor && !monitor(fmt::format("reading meshes, {} of {}", number, tasks.size()),
                            static_cast<double>(number - 1) / static_cast<double>(tasks.size())))
      throw LoadingStopped();
    tasks[i].file->read(*tasks[i].model, tasks[i].path, limits);
  };
  tbb::parallel_for(size_t{0}, tasks.size(), read_one, tbb::simple_partitioner());
}

std::shared_ptr<const MeshData> MeshFiles::mesh(const ParamReader& p, const std::filesystem::path& folder) {
  const Param* name = p.given("filename");
  if (!name) return {};
  const std::filesystem::path path = folder / name->strings[0];
  File& file = find(p.decl().name, path);
  if (!file.is_read) file.read(p.decl().name, path, p.diagnostics().limits());
  if (!std::exchange(file.is_reported, true))
    report_mesh_problems(file.problems, file.notes, name->value_loc, folder, name->strings[0], p.diagnostics());
  return file.mesh;
}

}  // namespace etd
