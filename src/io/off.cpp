// The mesh in an OFF file. Format: the Geomview manual, section "OFF Files", and what programs make of it: headers
// without the edge count or without the keyword, records broken over lines, colours under the plain keyword.
#include <algorithm>
#include <cmath>
#include <limits>

#include "io/mesh_faces.h"
#include "io/text_file.h"
#include "io/text_lines.h"

namespace etd {
namespace {

// What the keyword says that a vertex has, in this order; colours stand between normal and texture coordinates.
struct OffLayout {
  bool texture = false, colour = false, normal = false, homogeneous = false;
  size_t least() const { return 3u + homogeneous + (normal ? 3u : 0u) + (texture ? 2u : 0u); }
};

// [ST][C][N][4][n]OFF; nothing for any other word. `higher` when it has the n of any number of dimensions.
std::optional<OffLayout> parse_keyword(std::string_view word, bool& higher) {
  OffLayout layout;
  const auto take = [&word](std::string_view prefix) {
    if (word.substr(0, prefix.size()) != prefix) return false;
    word.remove_prefix(prefix.size());
    return true;
  };
  layout.texture = take("ST");
  layout.colour = take("C");
  layout.normal = take("N");
  layout.homogeneous = take("4");
  higher = take("n");
  if (word != "OFF") return {};
  return layout;
}

class OffReader {
 public:
  OffReader(std::string_view text, const Limits& limits) : lines_(text), limits_(limits) {}
  MeshResult read();

 private:
  bool read_header();
  bool read_counts();
  void read_vertices();
  void read_faces();
  bool next_word(std::string_view& word);
  size_t words_left() const { return words_.size() - at_; }
  bool next_line();
  bool read_number(const char* what, size_t index, double& value);
  bool read_face(size_t index);
  bool fail(std::string problem) {
    problems_.add(fmt::format("line {}: {}", lines_.line(), problem));
    return false;
  }
  void take_vertex(const std::vector<double>& values, size_t index);

  TextLines lines_;
  Limits limits_;
  std::vector<std::string_view> words_;
  size_t at_ = 0;  // next word of the line
  OffLayout layout_;
  size_t vertex_count_ = 0, face_count_ = 0;
  bool vertex_colours_ = false, face_colours_ = false;
  ProblemList problems_;
  std::vector<std::string> notes_;
  MeshData mesh_;
  FaceList faces_;
  std::vector<uint32_t> corners_;
  UnfitPositions unfit_;
  MeshLosses losses_;
};

bool OffReader::next_line() {
  at_ = 0;
  return lines_.next(words_);
}

// Reads on across line ends; false at the end of the file.
bool OffReader::next_word(std::string_view& word) {
  if (at_ == words_.size() && !next_line()) return false;
  word = words_[at_++];
  return true;
}

MeshResult OffReader::read() {
  if (read_header() && read_counts()) {
    read_vertices();
    if (problems_.empty()) read_faces();
  }
  if (mesh_.positions.size() == vertex_count_) finish_mesh(mesh_, faces_, unfit_, losses_, problems_);
  if (vertex_colours_) notes_.push_back("vertex colours are not used");
  if (face_colours_) notes_.push_back("face colours are not used");
  if (problems_.empty()) losses_.add_notes(notes_);
  MeshResult result;
  if (problems_.empty()) result.mesh = std::move(mesh_);
  result.problems = problems_.take();
  result.notes = std::move(notes_);
  return result;
}

bool OffReader::read_header() {
  if (!next_line()) return problems_.add("the file is empty"), false;
  bool higher = false;
  const std::string_view word = words_[0];
  if (const auto layout = parse_keyword(word, higher)) {
    if (higher) return fail(fmt::format("{} is a mesh in any number of dimensions, not in three", in_quotes(word)));
    layout_ = *layout;
    ++at_;
    if (words_left() > 0 && words_[1] == "BINARY") return fail("binary OFF files are not supported, only text");
    return true;
  }
  if (!word_to_integer(word))
    return fail(fmt::format(
        "{} begins no OFF file; valid: OFF, COFF, NOFF, STOFF and their combinations, or the counts", in_quotes(word)));
  notes_.push_back("the file does not begin with OFF, but is read as if it did");
  return true;
}

// Vertices, faces and, on the same line, edges, which nobody needs and many get wrong.
bool OffReader::read_counts() {
  size_t* const counts[] = {&vertex_count_, &face_count_};
  for (size_t i = 0; i < 2; ++i) {
    std::string_view word;
    if (!next_word(word)) return fail("the file ends before its counts");
    const auto count = word_to_integer(word);
    if (!count || *count < 0 || *count > std::numeric_limits<uint32_t>::max())
      return fail(fmt::format("{} is not a number of {}", in_quotes(word), i == 0 ? "vertices" : "faces"));
    *counts[i] = static_cast<size_t>(*count);
  }
  if (words_left() > 0 && word_to_integer(words_[at_])) ++at_;
  if (vertex_count_ == 0) return fail("the mesh has no vertices");
  if (face_count_ == 0) return fail("the mesh has no faces");
  return true;
}

bool OffReader::read_number(const char* what, size_t index, double& value) {
  std::string_view word;
  if (!next_word(word))
    return fail(
        fmt::format("the file ends in {} {}, before the {} that the header counts", what, index, vertex_count_));
  const auto number = word_to_number(word);
  if (!number) return fail(fmt::format("{} {}: {} is not a number", what, index, in_quotes(word)));
  value = *number;
  return true;
}

// The rest of the line of a vertex is its colour and texture coordinates, if every vertex has a line of its own.
// Otherwise a colour has the four components of the format's definition.
void OffReader::read_vertices() {
  const bool one_per_line = words_left() == 0 && lines_.count_rest() >= vertex_count_;
  const size_t before_colour = layout_.least() - (layout_.texture ? 2 : 0);
  std::vector<double> values;
  size_t usual_words = 0;
  for (size_t i = 0; i < vertex_count_; ++i) {
    values.clear();
    const auto read = [&](size_t count) {
      for (size_t k = 0; k < count; ++k)
        if (!read_number("vertex", i, values.emplace_back())) return false;
      return true;
    };
    if (!read(1)) return;
    if (one_per_line) {
      if (i == 0) usual_words = words_.size();
      if (words_.size() != usual_words) {
        fail(fmt::format("vertex {} has {} numbers, those before it {}: are there {} vertices, as the header says?", i,
                         words_.size(), usual_words, vertex_count_));
        return;
      }
      if (!read(std::max(before_colour - 1, words_left()))) return;
    } else if (!read(layout_.least() - 1 + (layout_.colour ? 4 : 0))) {
      return;
    }
    take_vertex(values, i);
  }
}

void OffReader::take_vertex(const std::vector<double>& values, size_t index) {
  const size_t least = layout_.least();
  if (values.size() < least) {
    fail(fmt::format("vertex {} has {} numbers instead of {}", index, values.size(), least));
    return;
  }
  vertex_colours_ = vertex_colours_ || values.size() > least;
  Point3d p{values[0], values[1], values[2]};
  size_t at = 3;
  if (layout_.homogeneous) {
    const double w = values[at++];
    p = {p.x / w, p.y / w, p.z / w};
  }
  unfit_.check(p, static_cast<uint32_t>(index), lines_.line());
  mesh_.positions.push_back(p);
  if (layout_.normal)
    mesh_.normals.push_back(finite_normal(to_float(Vec3d{values[at], values[at + 1], values[at + 2]}), losses_));
  if (layout_.texture)
    mesh_.uvs.push_back(finite_uv(
        {static_cast<float>(values[values.size() - 2]), static_cast<float>(values[values.size() - 1])}, losses_));
}

void OffReader::read_faces() {
  const bool one_per_line = words_left() == 0 && lines_.count_rest() >= face_count_;
  for (size_t i = 0; i < face_count_; ++i) {
    if (!read_face(i)) return;
    // Whatever follows the corners on their line is a colour: 1 to 4 numbers.
    if (one_per_line && words_left() > 0) {
      face_colours_ = true;
      at_ = words_.size();
    }
  }
  std::string_view word;
  if (next_word(word))
    fail(fmt::format("{} follows the last face: are there {} vertices and {} faces, as the header says?",
                     in_quotes(word), vertex_count_, face_count_));
}

// False when what follows cannot be read.
bool OffReader::read_face(size_t index) {
  std::string_view word;
  if (!next_word(word))
    return fail(fmt::format("the file ends after {} of the {} faces that the header counts", index, face_count_));
  const auto count = word_to_integer(word);
  if (!count || *count < 0)
    return fail(
        fmt::format("face {} begins with {}, not with its number of vertices: are there {} vertices, as the "
                    "header says?",
                    index, in_quotes(word), vertex_count_));
  if (static_cast<uint64_t>(*count) > limits_.corners) return fail(too_many_corners(limits_));
  bool good = true;
  corners_.clear();
  for (int64_t k = 0; k < *count; ++k) {
    if (!next_word(word)) return fail(fmt::format("the file ends in face {} of {}", index, face_count_));
    const auto vertex = word_to_integer(word);
    if (!vertex) return fail(fmt::format("face {}: {} is not the number of a vertex", index, in_quotes(word)));
    if (*vertex < 0 || static_cast<size_t>(*vertex) >= vertex_count_) {
      good = fail(fmt::format("face {}: vertex {} is out of range, the mesh has vertices 0 to {}", index, *vertex,
                              vertex_count_ - 1));
      continue;
    }
    corners_.push_back(static_cast<uint32_t>(*vertex));
  }
  if (good) faces_.add(corners_, losses_);
  return true;
}

}  // namespace

MeshResult read_off(const std::filesystem::path& path, const Limits& limits) {
  const FileBytes file = read_text_file(path, limits);
  if (file.error.empty()) return OffReader(file.bytes, limits).read();
  MeshResult result;
  result.problems.push_back(file.error);
  return result;
}

}  // namespace etd
