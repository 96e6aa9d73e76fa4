// The first radius of photon mapping: so many photons are found within it as it promises, where most of them are.
#include "integrators/photon_radius.h"

#include <gtest/gtest.h>

#include "core/hash.h"

namespace etd {
namespace {

// Photons spread evenly over a square of the plane z = 0, so many on a unit of area.
void add_photons(std::vector<Point3>& photons, float x0, float x1, float y0, float y1, double density) {
  HashStream rng(photons.size());
  const auto n = static_cast<size_t>(density * static_cast<double>((x1 - x0) * (y1 - y0)));
  for (size_t i = 0; i < n; ++i) {
    const float x = rng.next_float(), y = rng.next_float();
    photons.push_back({x0 + x * (x1 - x0), y0 + y * (y1 - y0), 0});
  }
}

std::vector<SeenPoint> grid(int side, double pixel_width) {
  std::vector<SeenPoint> seen;
  for (int i = 0; i < side * side; ++i)
    seen.push_back({{(static_cast<float>(i % side) + 0.5f) / static_cast<float>(side),
                     (static_cast<float>(i / side) + 0.5f) / static_cast<float>(side), 0},
                    pixel_width});
  return seen;
}

// Photons in the disk if they are spread with this density.
double photons_found(double radius, double density) { return radius * radius * static_cast<double>(kPi) * density; }

TEST(PhotonRadius, FindsFourPhotonsOfManyInAnIteration) {
  std::vector<Point3> photons;
  add_photons(photons, -1, 2, -1, 2, 1000);
  for (const double more : {1.1, 10.0, 1000.0}) {
    const double r = first_photon_radius(photons, grid(20, 1e-6), more);
    EXPECT_NEAR(photons_found(r, 1000 * more), 4, 0.8) << more;
  }
  // Where there will be too few, the disk is no larger than half of that which holds eight of those given.
  EXPECT_NEAR(photons_found(first_photon_radius(photons, grid(20, 1e-6), 0.01), 1000), 4, 0.8);
}

TEST(PhotonRadius, LooksWhereThePhotonsAre) {
  std::vector<Point3> photons;
  add_photons(photons, -1, 2, -1, 2, 100);
  add_photons(photons, 0.4f, 0.6f, 0.4f, 0.6f, 10000);  // of 400 + 100 that are seen
  EXPECT_NEAR(photons_found(first_photon_radius(photons, grid(20, 1e-6), 1), 10100), 4, 1.2);
}

TEST(PhotonRadius, IsHalfAPixelAtLeast) {
  std::vector<Point3> photons;
  add_photons(photons, 0, 1, 0, 1, 1000);
  EXPECT_DOUBLE_EQ(first_photon_radius(photons, grid(20, 0.5), 1), 0.25);
  EXPECT_DOUBLE_EQ(first_photon_radius({}, grid(20, 0.5), 1), 0.25);
  EXPECT_EQ(first_photon_radius(photons, {}, 1), 0);
}

}  // namespace
}  // namespace etd
