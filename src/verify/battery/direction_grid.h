// The sphere of directions cut into cells for histograms. A fixed grid would be too coarse for a sharp lobe and waste
// itself on empty regions, so cells are halved where pilot samples are dense; the samples that are tested afterwards
// are others. The horizon is a boundary between cells.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/vec.h"
#include "verify/battery/check.h"
#include "verify/statistics/quadrature.h"

namespace etd {

class DirectionGrid {
 public:
  // Halves cells, in theta or phi, until none holds more than `max_pilots` of the pilot directions and those in it are
  // spread over it.
  DirectionGrid(const std::vector<Vec3>& pilots, size_t max_pilots);

  size_t cell_count() const { return cells_.size(); }
  // x = theta from +z, y = phi; radians.
  const Rect& cell(size_t i) const { return cells_[i]; }
  size_t find(Vec3 w) const;

  // Integral over the solid angle of cell i of f, whose values are densities per solid angle. The error is below
  // `absolute` + 1e-3 of the value, far below where f is smooth. Where it jumps, the cell is halved `splits` times
  // before that is believed.
  std::array<double, 4> integrate(size_t i, const std::function<std::array<double, 4>(Vec3)>& f, double absolute,
                                  int splits = 0) const;

  // Observed against expected counts per cell: a map of the sphere (theta down, phi to the right) marking where more
  // (+, # beyond 5 sigma) or fewer (-, =) were found, and a table of the worst cells.
  std::string describe_worst(const std::vector<double>& observed, const std::vector<double>& expected) const;
  // The same as pictures of the sphere.
  CheckMap map(const std::vector<double>& observed, const std::vector<double>& expected) const;

 private:
  struct Node {
    Rect box;
    int first_child = -1;  // the second follows; -1: a leaf
    bool splits_theta = false;
    size_t cell = 0;
  };
  void split(size_t node, std::vector<Vec3d>& pilots, size_t begin, size_t end, size_t max_pilots, int depth);

  std::vector<Node> nodes_;
  std::vector<Rect> cells_;
};

}  // namespace etd
