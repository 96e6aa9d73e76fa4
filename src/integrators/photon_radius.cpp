#include "integrators/photon_radius.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace etd {

namespace {

constexpr size_t kNeighbours = 8;
// Measured on four scenes (docs/performance.md): caustics would like a quarter, rooms four times as many.
constexpr double kPhotonsWanted = 4, kPixelWidths = 0.5, kWidest = 0.7;

// The square of the distance to the k-th nearest photon, or to the last if there are fewer: k / (pi d^2) photons lie on
// a unit of area.
double square_of_distance(Point3 p, const std::vector<Point3>& photons) {
  std::array<double, kNeighbours> nearest;  // a heap, the largest first
  size_t count = 0;
  for (const Point3& photon : photons) {
    const Vec3d apart = to_double(photon - p);
    const double square = dot(apart, apart);
    if (count < kNeighbours) {
      nearest[count++] = square;
    } else if (square < nearest[0]) {
      std::pop_heap(nearest.begin(), nearest.end());
      nearest.back() = square;
    } else {
      continue;
    }
    std::push_heap(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(count));
  }
  return nearest[0];
}

}  // namespace

double first_photon_radius(const std::vector<Point3>& photons, const std::vector<SeenPoint>& seen, double more) {
  if (seen.empty()) return 0;
  std::vector<double> widths;
  for (const SeenPoint& s : seen) widths.push_back(s.pixel_width);
  std::nth_element(widths.begin(), widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2), widths.end());
  const double least = kPixelWidths * widths[widths.size() / 2];
  if (photons.empty()) return least;

  std::vector<double> areas;
  double density = 0;
  for (const SeenPoint& s : seen) {
    areas.push_back(std::max(square_of_distance(s.p, photons), 1e-300));
    density += 1 / areas.back();
  }
  std::sort(areas.begin(), areas.end());
  double below = 0;
  size_t median = 0;
  while (median + 1 < areas.size() && (below += 1 / areas[median]) < density / 2) ++median;
  const double wanted = kPhotonsWanted / (static_cast<double>(std::min(kNeighbours, photons.size())) * more);
  return std::max(least, std::sqrt(areas[median]) * std::min(kWidest, std::sqrt(wanted)));
}

}  // namespace etd
