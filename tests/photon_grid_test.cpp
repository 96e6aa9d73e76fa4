// Photons are found by place: all that are near, each once, in an order that depends on the photons alone.
#include "integrators/photon_grid.h"

#include <gtest/gtest.h>

#include <thread>

#include "core/hash.h"
#include "core/warp.h"

namespace etd {
namespace {

constexpr size_t kItems = 7;

std::vector<Photon> photons_of(size_t item, float size) {
  HashStream numbers(item + 1);
  std::vector<Photon> photons;
  for (int i = 0; i < 3000; ++i) {
    Photon photon{};
    for (int axis = 0; axis < 3; ++axis) photon.p[axis] = size * (numbers.next_float() - 0.5f);
    photon.flux = {static_cast<float>(item), static_cast<float>(i), 0};
    photons.push_back(photon);
  }
  return photons;
}

void fill(PhotonGrid& grid, float width, float size, size_t threads) {
  grid.start(kItems, width);
  std::vector<std::thread> workers;
  for (size_t t = 0; t < threads; ++t)
    workers.emplace_back([&, t] {
      for (size_t item = t; item < kItems; item += threads) {
        for (const Photon& photon : photons_of(item, size)) grid.add(item, photon);
        grid.finish_item(item);
      }
    });
  for (std::thread& w : workers) w.join();
  workers.clear();
  grid.begin_build();
  for (size_t t = 0; t < threads; ++t)
    workers.emplace_back([&, t] {
      for (size_t part = t; part < PhotonGrid::kParts; part += threads) grid.build(part);
    });
  for (std::thread& w : workers) w.join();
}

using Found = std::vector<std::array<float, 3>>;

Found near(const PhotonGrid& grid, Point3 p, float radius) {
  Found found;
  grid.for_photons_near(p, radius, [&](const Photon& photon) { found.push_back(photon.flux); });
  return found;
}

TEST(PhotonGrid, FindsAllThatAreNearAndEachOnce) {
  for (const float size : {1.0f, 2e-4f, 3e5f}) {
    PhotonGrid grid;
    for (const float width : {0.2f * size, 0.05f * size}) {  // again in the same grid
      fill(grid, width, size, 1);
      EXPECT_EQ(grid.photon_count(), 3000 * kItems);
      HashStream numbers(99);
      size_t met = 0;
      for (int i = 0; i < 200; ++i) {
        Point3 p;
        for (int axis = 0; axis < 3; ++axis) p[axis] = size * (numbers.next_float() - 0.5f);
        const float radius = 0.5f * width;
        Found found = near(grid, p, radius), expected;
        for (size_t item = 0; item < kItems; ++item)
          for (const Photon& photon : photons_of(item, size))
            if (const Vec3 d = photon.p - p; dot(d, d) <= radius * radius) expected.push_back(photon.flux);
        std::sort(found.begin(), found.end());
        std::sort(expected.begin(), expected.end());
        ASSERT_EQ(found, expected) << size << ' ' << width << ' ' << i;
        met += found.size();
      }
      EXPECT_GT(met, 100u);
    }
  }
}

TEST(PhotonGrid, TheOrderDoesNotDependOnThreads) {
  PhotonGrid one, three;
  fill(one, 0.3f, 1.0f, 1), fill(three, 0.3f, 1.0f, 3);
  for (int i = 0; i < 50; ++i) {
    const Point3 p{0.02f * static_cast<float>(i) - 0.5f, 0.1f, -0.2f};
    EXPECT_EQ(near(one, p, 0.15f), near(three, p, 0.15f));
  }
}

TEST(Photon, KeepsItsDirection) {
  HashStream numbers(5);
  for (int i = 0; i < 10000; ++i) {
    const float x = numbers.next_float(), y = numbers.next_float();
    const Vec3 w = sample_sphere_uniform({x, y});
    Photon photon{};
    photon.from = Photon::encode(w);
    EXPECT_LT(length(photon.direction() - w), 1e-4f);
    EXPECT_NEAR(length(photon.direction()), 1.0f, 1e-6f);
  }
  for (const Vec3 w : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}}) {
    Photon photon{};
    photon.from = Photon::encode(w);
    EXPECT_LT(length(photon.direction() - w), 1e-6f);
  }
}

}  // namespace
}  // namespace etd
