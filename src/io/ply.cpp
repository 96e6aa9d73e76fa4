// The mesh in a PLY file: finds positions, normals, texture coordinates and polygons among whatever elements and
// properties the file has, and checks every value it takes.
#include <algorithm>
#include <cmath>

#include "io/mesh_faces.h"
#include "io/ply_body.h"
#include "io/ply_header.h"
#include "io/text_file.h"

namespace etd {
namespace {

// The wanted vertex properties land in PlyValues::scalars in this order.
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
  PlyMeshReader(std::string_view file, const Limits& limits) : file_(file), limits_(limits) {}
  MeshResult read();

 private:
  void plan_vertices();
  void plan_faces();
  PlyPlan plan_indices(const PlyElement& element);
  void note_unused(const PlyPlan& plan);
  bool read_elements(PlyBody& body);
  void take_vertex(const PlyScalars& values, uint64_t index, int line);
  void take_face(const PlyBody& body, const PlyValues& values, uint64_t index);
  void take_strips(const PlyBody& body, const PlyValues& values, uint64_t index);
  bool is_vertex(double index) const {
    return index >= 0 && index < static_cast<double>(vertices_.element->count) && index == std::floor(index);
  }
  void no_vertex(const PlyBody& body, const PlyElement& element, uint64_t index, double vertex);

  std::string_view file_;
  Limits limits_;
  ProblemList problems_;
  std::vector<std::string> notes_;
  PlyHeader header_;
  PlyPlan vertices_{}, faces_{}, strips_{};
  bool has_normals_ = false, has_uvs_ = false;
  MeshData mesh_;
  FaceList face_list_;
  double strip_end_ = -1;
  std::vector<uint32_t> corners_;
  UnfitPositions unfit_;
  MeshLosses losses_;
};

MeshResult PlyMeshReader::read() {
  if (std::optional<PlyHeader> header = read_ply_header(file_, problems_)) {
    header_ = std::move(*header);
    plan_vertices();
    plan_faces();
    for (const PlyElement& element : header_.elements) {
      if (&element != vertices_.element && &element != faces_.element && &element != strips_.element &&
          element.count > 0) {
        notes_.push_back(fmt::format("element {} is not used", in_quotes(element.name)));
      }
    }
    if (problems_.empty()) {
      const std::unique_ptr<PlyBody> body = open_ply_body(header_, file_);
      if (read_elements(*body)) {
        if (std::string extra = body->leftover(); !extra.empty()) problems_.add(std::move(extra));
      }
    }
    if (vertices_.element && mesh_.positions.size() == vertices_.element->count)
      finish_mesh(mesh_, face_list_, unfit_, losses_, problems_);
    if (problems_.empty()) losses_.add_notes(notes_);
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
  const PlyElement* faces = header_.find("face");
  const PlyElement* strips = header_.find("tristrips");
  if (strips == nullptr) strips = header_.find("tristrip");
  if (faces == nullptr && strips == nullptr)
    return problems_.add("the file has no element \"face\": a cloud of points is not a mesh");
  const PlyElement& any = faces ? *faces : *strips;
  if ((!faces || faces->count == 0) && (!strips || strips->count == 0))
    problems_.add(fmt::format("line {}: the mesh has no faces", any.line));
  if (faces) faces_ = plan_indices(*faces);
  if (!strips) return;
  strips_ = plan_indices(*strips);
  for (size_t i = 0; i < strips_.slots.size(); ++i)
    if (strips_.slots[i] != PlyPlan::kSkip) strip_end_ = ply_all_bits(strips->properties[i].type);
}

PlyPlan PlyMeshReader::plan_indices(const PlyElement& element) {
  PlyPlan plan = skip_all(element);
  bool found = false;
  for (const std::string_view name : kIndexNames) {
    const PlyProperty* property = element.find(name);
    if (found || property == nullptr || !property->count_type) continue;
    want(plan, name, 0);
    found = true;
  }
  if (!found) {
    problems_.add(fmt::format("line {}: element {} has no list \"vertex_indices\" or \"vertex_index\"", element.line,
                              in_quotes(element.name)));
  }
  note_unused(plan);
  return plan;
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
  std::vector<PlyScalars> rows;
  for (const PlyElement& element : header_.elements) {
    if (element.properties.empty()) continue;
    // This comes before anything is allocated: a header may promise more than the file can hold.
    if (const double least = body.least_bytes(element); least > static_cast<double>(body.bytes_left())) {
      problems_.add(
          fmt::format("line {}: {} of element {} take at least {:.0f} bytes, but only {} are left in the file",
                      element.line, element.count, in_quotes(element.name), least, body.bytes_left()));
      return false;
    }
    const bool is_vertex = &element == vertices_.element, is_face = &element == faces_.element;
    const bool is_strip = &element == strips_.element;
    const PlyPlan plan = is_vertex ? vertices_ : is_face ? faces_ : is_strip ? strips_ : skip_all(element);
    if (is_vertex) {
      mesh_.positions.reserve(element.count);
      if (has_normals_) mesh_.normals.reserve(element.count);
      if (has_uvs_) mesh_.uvs.reserve(element.count);
    } else if (is_face) {
      face_list_.reserve(element.count);
    }
    for (uint64_t i = 0; i < element.count; ++i) {
      if (is_face) i += body.read_triangles(plan, element.count - i, vertices_.element->count, face_list_);
      if (!is_face && !is_strip) {
        body.read_rows(plan, element.count - i, rows);
        for (size_t k = 0; is_vertex && k < rows.size(); ++k) take_vertex(rows[k], i + k, 0);
        i += rows.size();
      }
      if (i == element.count) break;
      const PlyStep step = body.read(plan, values);
      if (step == PlyStep::kDone) {
        if (is_vertex) take_vertex(values.scalars, i, body.line());
        if (is_face) take_face(body, values, i);
        if (is_strip) take_strips(body, values, i);
        continue;
      }
      problems_.add(fmt::format("{} of {}: {}", body.place(element, i), element.count, body.error()));
      if (step == PlyStep::kLost) return false;
    }
  }
  return true;
}

void PlyMeshReader::take_vertex(const PlyScalars& v, uint64_t index, int line) {
  const auto as_float = [&v](int slot) { return static_cast<float>(v[static_cast<size_t>(slot)]); };
  mesh_.positions.push_back({v[0], v[1], v[2]});
  unfit_.check(mesh_.positions.back(), static_cast<uint32_t>(index), line);
  if (has_normals_)
    mesh_.normals.push_back(finite_normal({as_float(kNormal), as_float(kNormal + 1), as_float(kNormal + 2)}, losses_));
  if (has_uvs_) mesh_.uvs.push_back(finite_uv({as_float(kUv), as_float(kUv + 1)}, losses_));
}

void PlyMeshReader::no_vertex(const PlyBody& body, const PlyElement& element, uint64_t index, double vertex) {
  problems_.add(fmt::format("{}: vertex index {} is out of range, the mesh has vertices 0 to {}",
                            body.place(element, index), vertex, vertices_.element->count - 1));
}

void PlyMeshReader::take_face(const PlyBody& body, const PlyValues& values, uint64_t index) {
  if (values.list.size() > limits_.corners)
    return problems_.add(fmt::format("{}: {}", body.place(*faces_.element, index), too_many_corners(limits_)));
  corners_.clear();
  for (const double corner : values.list) {
    if (is_vertex(corner))
      corners_.push_back(static_cast<uint32_t>(corner));
    else
      no_vertex(body, *faces_.element, index, corner);
  }
  if (corners_.size() == values.list.size()) face_list_.add(corners_, losses_);
}

// Each vertex makes a triangle with the two before it, whose order alternates so that all face the same way; -1 begins
// the next strip. Triangles of two equal corners are how strips are joined, and no loss.
void PlyMeshReader::take_strips(const PlyBody& body, const PlyValues& values, uint64_t index) {
  corners_.clear();
  const auto end_strip = [this] {
    losses_.small_faces += corners_.size() == 1 || corners_.size() == 2;
    for (size_t i = 2; i < corners_.size(); ++i) {
      const uint32_t a = corners_[i - 2], b = corners_[i - 1], c = corners_[i];
      if (a == b || b == c || c == a) continue;
      if (i % 2 == 0)
        face_list_.add_triangle(a, b, c);
      else
        face_list_.add_triangle(b, a, c);
    }
    corners_.clear();
  };
  for (const double corner : values.list) {
    if (is_vertex(corner))
      corners_.push_back(static_cast<uint32_t>(corner));
    else if (corner == strip_end_)
      end_strip();
    else
      no_vertex(body, *strips_.element, index, corner);
  }
  end_strip();
}

}  // namespace

MeshResult read_ply(const std::filesystem::path& path, const Limits& limits) {
  const FileBytes file = read_text_file(path, limits);
  if (file.error.empty()) return PlyMeshReader(file.bytes, limits).read();
  MeshResult result;
  result.problems.push_back(file.error);
  return result;
}

}  // namespace etd
