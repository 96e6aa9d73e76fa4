#include "io/obj.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>

#include "core/hash.h"
#include "io/mesh_faces.h"
#include "io/missing_file.h"
#include "io/text_file.h"
#include "io/text_lines.h"

namespace etd {

namespace {

constexpr int64_t kNone = -1;

// One corner of a face: indices from 0 of position, texture coordinates and normal.
using Corner = std::array<int64_t, 3>;
struct CornerHash {
  size_t operator()(const Corner& c) const {
    return hash_combine(static_cast<uint64_t>(c[0]), static_cast<uint64_t>(c[1]), static_cast<uint64_t>(c[2]));
  }
};

// A part that grows: corners that are the same in everything become one vertex.
struct PartBuilder {
  std::string material;
  std::vector<Corner> vertices;
  std::unordered_map<Corner, uint32_t, CornerHash> index_of;
  FaceList faces;

  uint32_t vertex(const Corner& c) {
    const auto [it, is_new] = index_of.emplace(c, static_cast<uint32_t>(vertices.size()));
    if (is_new) vertices.push_back(c);
    return it->second;
  }
};

class ObjReader {
 public:
  // Without materials, all faces make one part.
  ObjReader(std::string_view text, std::filesystem::path folder, bool materials, const Limits& limits)
      : lines_(text), folder_(std::move(folder)), materials_(materials), limits_(limits) {}
  ObjResult read();

 private:
  void statement();
  void vertex();
  void texture_coordinates();
  void normal();
  void face();
  bool corner(std::string_view word, Corner& c);
  void use_material(std::string name);
  void load_materials();
  MeshData finish(PartBuilder& part);
  void count_vertices();
  bool numbers(size_t least, size_t most, std::array<double, 8>& values);
  void fail(const std::string& problem) { problems_.add(fmt::format("line {}: {}", lines_.line(), problem)); }

  TextLines lines_;
  std::filesystem::path folder_;
  bool materials_;
  Limits limits_;
  std::vector<std::string_view> words_;
  std::vector<Point3d> positions_;
  std::vector<Vec2> uvs_;
  std::vector<Vec3> normals_;
  UnfitPositions unfit_;
  MeshLosses losses_;
  std::vector<uint32_t> corners_;
  std::vector<PartBuilder> parts_;
  std::map<std::string, size_t> part_of_;
  size_t part_ = 0;
  bool colours_ = false, no_uvs_ = false;
  std::set<std::string> unused_;
  std::set<std::filesystem::path> loaded_;
  ProblemList problems_;
  ObjResult result_;
};

ObjResult ObjReader::read() {
  use_material("");
  // The limit counts the keyword, and one word to see that there are more.
  while (lines_.next(words_, true, limits_.corners + 2)) statement();
  count_vertices();
  if (problems_.empty())
    for (PartBuilder& part : parts_)
      if (MeshData mesh = finish(part); !mesh.triangles.empty())
        result_.parts.push_back({part.material, std::move(mesh)});
  if (problems_.empty() && result_.parts.empty()) problems_.add(kNoFaces);
  if (colours_) result_.notes.push_back("vertex colours are not used");
  if (problems_.empty()) losses_.add_notes(result_.notes);
  if (no_uvs_) result_.notes.push_back("corners without texture coordinates have (0, 0), as others have them");
  if (!unused_.empty()) result_.notes.push_back(fmt::format("statements not used: {}", fmt::join(unused_, ", ")));
  result_.problems = problems_.take();
  return std::move(result_);
}

void ObjReader::statement() {
  const std::string_view key = words_[0];
  if (words_.size() > limits_.corners + 1)
    return fail(fmt::format("{} has too many values; {}", in_quotes(key), limit_text(limits_, &Limits::corners)));
  if (key == "v") return vertex();
  if (key == "vt") return texture_coordinates();
  if (key == "vn") return normal();
  if (key == "f" || key == "fo") return face();
  if (key == "usemtl") return materials_ ? use_material(join_words(words_, 1)) : void();
  if (key == "mtllib") return materials_ ? load_materials() : void();
  // Groups only matter to editors, and smoothing is what vertex normals say.
  if (key == "g" || key == "o" || key == "s") return;
  unused_.insert(std::string(key.substr(0, 40)));
}

// All words behind the first as numbers; a problem when their count or one of them is wrong.
bool ObjReader::numbers(size_t least, size_t most, std::array<double, 8>& values) {
  const size_t count = words_.size() - 1;
  if (count < least || count > most) {
    fail(fmt::format("\"{}\" has {} numbers, it needs {}", words_[0], count,
                     least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most)));
    return false;
  }
  values.fill(0);
  for (size_t i = 0; i < count; ++i) {
    const auto value = word_to_number(words_[i + 1]);
    if (!value) {
      fail(fmt::format("{} is not a number", in_quotes(words_[i + 1])));
      return false;
    }
    values[i] = *value;
  }
  return true;
}

// x y z, with the weight of rational curves, a colour, or both behind them. A wrong vertex keeps its number, so that
// faces are not wrong for it too.
void ObjReader::vertex() {
  std::array<double, 8> x{};
  numbers(3, 7, x);
  unfit_.check({x[0], x[1], x[2]}, static_cast<uint32_t>(positions_.size()), lines_.line());
  positions_.push_back({x[0], x[1], x[2]});
  colours_ = colours_ || words_.size() > 5;
}

void ObjReader::texture_coordinates() {
  std::array<double, 8> x{};
  numbers(1, 3, x);
  uvs_.push_back(finite_uv({static_cast<float>(x[0]), static_cast<float>(x[1])}, losses_));
}

void ObjReader::normal() {
  std::array<double, 8> x{};
  numbers(3, 3, x);
  normals_.push_back(finite_normal(to_float(Vec3d{x[0], x[1], x[2]}), losses_));
}

// "v", "v/vt", "v//vn" or "v/vt/vn", counted from 1 or, when negative, backwards from what was read last.
bool ObjReader::corner(std::string_view word, Corner& c) {
  const size_t counts[3] = {positions_.size(), uvs_.size(), normals_.size()};
  static constexpr const char* kNames[3] = {"vertex", "texture coordinate", "normal"};
  c = {kNone, kNone, kNone};
  std::string_view left = word;
  for (size_t i = 0; i < 3; ++i) {
    const size_t slash = std::min(left.find('/'), left.size());
    const std::string_view number = left.substr(0, slash);
    if (!number.empty()) {
      const auto index = word_to_integer(number);
      if (!index || *index == 0) break;
      const auto count = static_cast<int64_t>(counts[i]);
      c[i] = *index > 0 ? *index - 1 : count + *index;
      if (c[i] < 0 || c[i] >= count) {
        fail(fmt::format("{} {} does not exist: {} have been read", kNames[i], *index, count));
        return false;
      }
    }
    if (slash == left.size()) {
      if (c[0] != kNone) return true;
      break;
    }
    left.remove_prefix(slash + 1);
  }
  fail(fmt::format("{} is no corner of a face; valid: v, v/vt, v//vn and v/vt/vn, counted from 1", in_quotes(word)));
  return false;
}

void ObjReader::face() {
  PartBuilder& part = parts_[part_];
  corners_.clear();
  for (size_t k = 1; k < words_.size(); ++k) {
    Corner c;
    if (!corner(words_[k], c)) return;
    corners_.push_back(part.vertex(c));
  }
  part.faces.add(corners_, losses_);
}

void ObjReader::use_material(std::string name) {
  const auto [it, is_new] = part_of_.emplace(name, parts_.size());
  if (is_new) parts_.emplace_back().material = std::move(name);
  part_ = it->second;
}

// Several files, or one with blanks in its name.
void ObjReader::load_materials() {
  std::vector<std::string> names(words_.begin() + 1, words_.end());
  std::error_code ignored;
  if (const std::string whole = join_words(words_, 1);
      whole.size() <= kLongestName && std::filesystem::exists(folder_ / whole, ignored))
    names = {whole};
  for (std::string& name : names) {
    std::replace(name.begin(), name.end(), '\\', '/');
    if (name.size() > kLongestName || !loaded_.insert(std::filesystem::path(name).lexically_normal()).second) continue;
    const std::filesystem::path file = name;
    std::string error = read_mtl(folder_ / file, file.parent_path(), limits_, result_);
    if (error.empty()) continue;
    // Looking through folders for hundreds of files would take longer than anybody reads.
    constexpr size_t kSought = 20;
    std::string missing = loaded_.size() <= kSought ? missing_file_hint({folder_}, name) : std::string();
    std::replace(missing.begin(), missing.end(), '\n', ' ');
    if (!missing.empty()) error += "; " + missing;
    result_.notes.push_back(fmt::format("line {}: cannot read {}: {}", lines_.line(), in_quotes(name), error));
  }
}

// Which vertices of the file its faces use, by their positions.
void ObjReader::count_vertices() {
  std::vector<bool> used(positions_.size());
  for (const PartBuilder& part : parts_)
    part.faces.for_each_corner([&](uint32_t corner) { used[static_cast<size_t>(part.vertices[corner][0])] = true; });
  unfit_.report(positions_, used, 1, problems_);
  losses_.unused_vertices = static_cast<size_t>(std::count(used.begin(), used.end(), false));
}

MeshData ObjReader::finish(PartBuilder& part) {
  MeshData mesh;
  bool any_uv = false, any_normal = false, all_uvs = true;
  for (const Corner& c : part.vertices) {
    any_uv = any_uv || c[1] != kNone;
    all_uvs = all_uvs && c[1] != kNone;
    any_normal = any_normal || c[2] != kNone;
  }
  no_uvs_ = no_uvs_ || (any_uv && !all_uvs);
  for (const Corner& c : part.vertices) {
    mesh.positions.push_back(positions_[static_cast<size_t>(c[0])]);
    if (any_uv) mesh.uvs.push_back(c[1] == kNone ? Vec2{} : uvs_[static_cast<size_t>(c[1])]);
    if (any_normal) mesh.normals.push_back(c[2] == kNone ? Vec3{} : normals_[static_cast<size_t>(c[2])]);
  }
  mesh.triangles = part.faces.take_triangles(mesh.positions, losses_);
  drop_unused_vertices(mesh);  // corners of faces that were left out
  return mesh;
}

ObjResult read(const std::filesystem::path& path, bool materials, const Limits& limits) {
  const FileBytes file = read_text_file(path, limits);
  if (file.error.empty()) return ObjReader(file.bytes, path.parent_path(), materials, limits).read();
  ObjResult result;
  result.problems.push_back(file.error);
  return result;
}

}  // namespace

ObjResult read_obj(const std::filesystem::path& path, const Limits& limits) { return read(path, true, limits); }

MeshResult read_obj_mesh(const std::filesystem::path& path, const Limits& limits) {
  ObjResult parts = read(path, false, limits);
  MeshResult result{{}, std::move(parts.problems), std::move(parts.notes)};
  if (!parts.parts.empty()) result.mesh = std::move(parts.parts[0].mesh);
  return result;
}

}  // namespace etd
