// The data of a PLY file, element by element, the same for the reader of the mesh whatever the encoding.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh_faces.h"
#include "io/ply_header.h"

namespace etd {

// What of an element is wanted: for each property the index of its value in PlyValues::scalars, or kSkip; a list that
// is not skipped goes to PlyValues::list.
struct PlyPlan {
  static constexpr int kSkip = -1;
  const PlyElement* element;
  std::vector<int> slots;
};

using PlyScalars = std::array<double, 8>;

// The wanted values of one element; a float stays exactly itself, and so does every integer type of the format.
struct PlyValues {
  PlyScalars scalars{};
  std::vector<double> list;
};

// How reading one element went. kBad: something is wrong with it, but the next one can be read. kLost: nothing after
// this point can be read.
enum class PlyStep { kDone, kBad, kLost };

class PlyBody {
 public:
  virtual ~PlyBody() = default;
  // Reads the next element of the file.
  virtual PlyStep read(const PlyPlan& plan, PlyValues& values) = 0;
  // Reads the next elements, at most `most`, faster than one by one, and fills in a row of scalars for each; none where
  // that is not possible, which read() then tells more about. Nothing can be wrong with those that are read.
  virtual void read_rows(const PlyPlan&, uint64_t /*most*/, std::vector<PlyScalars>& rows) { rows.clear(); }
  // Adds faces of three different corners below `vertices`, at most `most`, as long as one follows the other, and
  // returns how many; read() tells what stands behind them.
  virtual uint64_t read_triangles(const PlyPlan&, uint64_t /*most*/, uint64_t /*vertices*/, FaceList&) { return 0; }
  // The line of the element read last, 0 in binary.
  virtual int line() const = 0;
  // Says where that element stands: "line 12: vertex 3" in text, "vertex 3" in binary, counted from 0.
  std::string place(const PlyElement& element, uint64_t index) const {
    return fmt::format("{}{} {}", line() > 0 ? fmt::format("line {}: ", line()) : "", element.name, index);
  }
  // The least number of bytes that all elements of this kind take.
  virtual double least_bytes(const PlyElement& element) const = 0;
  virtual size_t bytes_left() const = 0;
  // What stands behind the last element although nothing should: a problem, or empty.
  virtual std::string leftover() const = 0;
  // What was wrong when read() returned kBad or kLost.
  const std::string& error() const { return error_; }

 protected:
  std::string error_;
};

// The body behind `header` in `file`, both of which must outlive it.
std::unique_ptr<PlyBody> open_ply_body(const PlyHeader& header, std::string_view file);

}  // namespace etd
