// The mesh in a PLY file: finds positions, normals, texture coordinates and polygons among whatever elements and
// properties the file has, and checks every value it takes.
#include <algorithm>
#include <cmath>

#include "io/gzip.h"
#include "io/mesh.h"
#include "io/ply_body.h"
#include "io/ply_header.h"

namespace etd {
namespace {

// Where the wanted vertex properties land in PlyValues::scalars.
constexpr std::string_view kSlotNames[] = {"x", "y", "z", "nx", "ny", "nz"};
constexpr int kNormal = 3, kUv = 6;
constexpr std::string_view kUvNames[][2] = {
    {"u", "v"}, {"s", "t"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}};
constexpr std::string_view kIndexNames[] = {"vertex_indices", "vertex_index"};

PlyPlan skip_all(const PlyElement& element) {
  return {&element, std::vector<int>(element.properties.size(), PlyPlan::kSkip)};
}

bool has_scalar(const PlyElement& element, std::string_view name) {
  const PlyProperty* property = element.find(name);
  return property != nullptr && !property->count_type;
}

void want(PlyPlan& plan, std::string_view name, int slot) {
  plan.slots[static_cast<size_t>(plan.element->find(name) - plan.element->properties.data())] = slot;
}

class PlyMeshReader {
 public:
  explicit PlyMeshReader(std::string_view file) : file_(file) {}
  MeshResult read();

 private:
  void plan_vertices();
  void plan_faces();
  void check_strips();
  void note_unused(const PlyPlan& plan);
  bool read_elements(PlyBody& body);
  void take_vertex(const PlyBody& body, const PlyValues& values, uint64_t index);
  void take_face(const PlyBody& body, const PlyValues& values, uint64_t index);
  // Whether the wanted values of a vertex are finite as floats; problems where not.
  bool finite(const PlyBody& body, const PlyValues& values, uint64_t index);

  std::string_view file_;
  ProblemList problems_;
  std::vector<std::string> notes_;
  PlyHeader header_;
  PlyPlan vertices_{}, faces_{};
  bool has_normals_ = false, has_uvs_ = false;
  MeshData mesh_;
};

MeshResult PlyMeshReader::read() {
  if (std::optional<PlyHeader> header = read_ply_header(file_, problems_)) {
    header_ = std::move(*header);
    plan_vertices();
    plan_faces();
    check_strips();
    for (const PlyElement& element : header_.elements) {
      if (&element != vertices_.element && &element != faces_.element && element.count > 0) {
        notes_.push_back(fmt::format("element {} is not used", in_quotes(element.name)));
      }
    }
    if (problems_.empty()) {
      const std::unique_ptr<PlyBody> body = open_ply_body(header_, file_);
      if (read_elements(*body)) {
        if (std::string extra = body->leftover(); !extra.empty()) problems_.add(std::move(extra));
      }
    }
  }
  MeshResult result;
  if (problems_.empty()) result.mesh = std::move(mesh_);
  result.problems = problems_.take();
  result.notes = std::move(notes_);
  return result;
}

void PlyMeshReader::plan_vertices() {
  const PlyElement* element = header_.find("vertex");
  if (element == nullptr) return problems_.add("the file has no element \"vertex\"");
  if (element->count == 0) problems_.add(fmt::format("line {}: the mesh has no vertices", element->line));
  if (element->count > UINT32_MAX) {
    problems_.add(fmt::format("line {}: more vertices than 32-bit indices reach", element->line));
  }
  vertices_ = skip_all(*element);
  const auto has_all = [element](auto begin, auto end) {
    return std::all_of(begin, end, [element](std::string_view name) { return has_scalar(*element, name); });
  };
  for (int i = 0; i < kNormal; ++i) {
    if (!has_scalar(*element, kSlotNames[i])) {
      problems_.add(fmt::format("line {}: element \"vertex\" has no number \"{}\"", element->line, kSlotNames[i]));
    } else {
      want(vertices_, kSlotNames[i], i);
    }
  }
  has_normals_ = has_all(kSlotNames + kNormal, kSlotNames + kUv);
  for (int i = kNormal; has_normals_ && i < kUv; ++i) want(vertices_, kSlotNames[i], i);
  for (const auto& names : kUvNames) {
    if (has_uvs_ || !has_all(names, names + 2)) continue;
    has_uvs_ = true;
    want(vertices_, names[0], kUv);
    want(vertices_, names[1], kUv + 1);
  }
  note_unused(vertices_);
}

void PlyMeshReader::plan_faces() {
  const PlyElement* element = header_.find("face");
  if (element == nullptr) return problems_.add("the file has no element \"face\": a cloud of points is not a mesh");
  if (element->count == 0) problems_.add(fmt::format("line {}: the mesh has no faces", element->line));
  faces_ = skip_all(*element);
  bool found = false;
  for (const std::string_view name : kIndexNames) {
    const PlyProperty* property = element->find(name);
    if (found || property == nullptr || !property->count_type) continue;
    want(faces_, name, 0);
    found = true;
  }
  if (!found) {
    problems_.add(
        fmt::format("line {}: element \"face\" has no list \"vertex_indices\" or \"vertex_index\"", element->line));
  }
  note_unused(faces_);
}

void PlyMeshReader::check_strips() {
  for (const char* name : {"tristrips", "tristrip"}) {
    const PlyElement* strips = header_.find(name);
    if (strips == nullptr || strips->count == 0) continue;
    problems_.add(fmt::format("line {}: triangle strips ({}) are not supported, only element \"face\"", strips->line,
                              in_quotes(name)));
  }
}

void PlyMeshReader::note_unused(const PlyPlan& plan) {
  std::string names;
  for (size_t i = 0; i < plan.slots.size(); ++i) {
    if (plan.slots[i] != PlyPlan::kSkip) continue;
    names += (names.empty() ? "" : ", ") + in_quotes(plan.element->properties[i].name);
  }
  if (!names.empty()) {
    notes_.push_back(fmt::format("properties of element {} not used: {}", in_quotes(plan.element->name), names));
  }
}

// Returns false when the data were lost before their end.
bool PlyMeshReader::read_elements(PlyBody& body) {
  PlyValues values;
  for (const PlyElement& element : header_.elements) {
    if (element.properties.empty()) continue;
    // Before anything is allocated: a header may promise more than the file can hold.
    if (const double least = body.least_bytes(element); least > static_cast<double>(body.bytes_left())) {
      problems_.add(
          fmt::format("line {}: {} of element {} take at least {:.0f} bytes, but only {} are left in the file",
                      element.line, element.count, in_quotes(element.name), least, body.bytes_left()));
      return false;
    }
    const bool is_vertex = &element == vertices_.element, is_face = &element == faces_.element;
    const PlyPlan plan = is_vertex ? vertices_ : (is_face ? faces_ : skip_all(element));
    if (is_vertex) {
      mesh_.positions.reserve(element.count);
      if (has_normals_) mesh_.normals.reserve(element.count);
      if (has_uvs_) mesh_.uvs.reserve(element.count);
    } else if (is_face) {
      mesh_.triangles.reserve(element.count);
    }
    for (uint64_t i = 0; i < element.count; ++i) {
      const PlyStep step = body.read(plan, values);
      if (step == PlyStep::kDone) {
        if (is_vertex) take_vertex(body, values, i);
        if (is_face) take_face(body, values, i);
        continue;
      }
      problems_.add(fmt::format("{} of {}: {}", body.place(element, i), element.count, body.error()));
      if (step == PlyStep::kLost) return false;
    }
  }
  return true;
}

bool PlyMeshReader::finite(const PlyBody& body, const PlyValues& values, uint64_t index) {
  bool all = true;
  for (size_t i = 0; i < vertices_.slots.size(); ++i) {
    if (vertices_.slots[i] == PlyPlan::kSkip) continue;
    const double value = values.scalars[static_cast<size_t>(vertices_.slots[i])];
    if (std::isfinite(static_cast<float>(value))) continue;
    problems_.add(fmt::format("{}: {} is {}, not a finite number", body.place(*vertices_.element, index),
                              vertices_.element->properties[i].name, value));
    all = false;
  }
  return all;
}

void PlyMeshReader::take_vertex(const PlyBody& body, const PlyValues& values, uint64_t index) {
  if (!finite(body, values, index)) return;
  const auto& v = values.scalars;
  const auto as_float = [&v](int slot) { return static_cast<float>(v[static_cast<size_t>(slot)]); };
  mesh_.positions.push_back({v[0], v[1], v[2]});
  if (has_normals_) mesh_.normals.push_back({as_float(kNormal), as_float(kNormal + 1), as_float(kNormal + 2)});
  if (has_uvs_) mesh_.uvs.push_back({as_float(kUv), as_float(kUv + 1)});
}

void PlyMeshReader::take_face(const PlyBody& body, const PlyValues& values, uint64_t index) {
  const uint64_t vertex_count = vertices_.element->count;
  const std::vector<double>& corners = values.list;
  if (corners.size() < 3) {
    return problems_.add(
        fmt::format("{}: has {} vertices, a face needs 3", body.place(*faces_.element, index), corners.size()));
  }
  bool good = true;
  for (const double corner : corners) {
    if (corner >= 0 && corner < static_cast<double>(vertex_count) && corner == std::floor(corner)) continue;
    problems_.add(fmt::format("{}: vertex index {} is out of range, the mesh has vertices 0 to {}",
                              body.place(*faces_.element, index), corner, vertex_count - 1));
    good = false;
  }
  if (!good) return;
  for (size_t i = 2; i < corners.size(); ++i) {
    mesh_.triangles.push_back(
        {static_cast<uint32_t>(corners[0]), static_cast<uint32_t>(corners[i - 1]), static_cast<uint32_t>(corners[i])});
  }
}

}  // namespace

MeshResult read_ply(const std::filesystem::path& path) {
  const FileBytes file = read_file_uncompressed(path);
  if (file.error.empty()) return PlyMeshReader(file.bytes).read();
  MeshResult result;
  result.problems.push_back(file.error);
  return result;
}

}  // namespace etd
