// Photons of one iteration, found by place: a hash table of cubes as wide as the search is (Teschner et al. 2003),
// built on all threads. What it finds, and in which order, depends on the photons alone.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/vec.h"
#include "spectrum/spectrum.h"

namespace etd {

struct Photon {
  Point3 p;
  std::array<int16_t, 2> from;  // the direction that it came from, as a point of the octahedral square
  uint16_t events = 0;          // scattering events before it came here
  bool hidden = false;          // paths from the camera that go on from here do not find its light
  std::array<float, 3> flux;    // W over the cosine between its direction and the surface's geometric normal

  static std::array<int16_t, 2> encode(Vec3 w);
  Vec3 direction() const;
};

class PhotonGrid {
 public:
  // Memory of a photon: in its item, its cube, in its part, and its share of the cells.
  static constexpr uint64_t kBytesOfPhoton = 2 * sizeof(Photon) + 16;
  // Forgets all photons, and makes room for those of this many items. `width` is that of the cubes: searches may have
  // half of it as radius.
  void start(size_t items, float width);
  // Keeps the photon; each item may do so while others do.
  void add(size_t item, const Photon& photon) { items_[item].photons.push_back(photon); }
  // When an item has all its photons: sorts them by part of the table.
  void finish_item(size_t item);
  // Makes one of kParts parts of the table; after begin_build(), each may be made while others are.
  static constexpr size_t kParts = 64;
  void begin_build();
  void build(size_t part);

  size_t photon_count() const { return photon_count_; }
  // Calls f with each photon no further than `radius` from p.
  template <class F>
  void for_photons_near(Point3 p, float radius, F&& f) const;

 private:
  struct Item {
    std::vector<Photon> photons;
    std::vector<uint32_t> hashes;              // of the photons's cubes
    std::array<uint32_t, kParts + 1> parts{};  // where each part begins
  };
  struct Part {
    std::vector<Photon> photons;        // by cell
    std::vector<uint32_t> cell_begins;  // one for each cell of the part, and the end
  };

  std::array<int64_t, 3> cube(Point3 p, double shift) const;
  // The upper six bits name the part of the table, the lower ones the cell in it.
  uint32_t hash(int64_t x, int64_t y, int64_t z) const;

  double width_ = 1;
  uint32_t cells_per_part_ = 1;  // a power of two
  size_t photon_count_ = 0;
  std::vector<Item> items_;
  std::array<Part, kParts> parts_;
};

template <class F>
void PhotonGrid::for_photons_near(Point3 p, float radius, F&& f) const {
  // The cubes around the corner that is nearest to p; several may share a cell of the table.
  const std::array<int64_t, 3> first = cube(p, -0.5);
  std::array<uint32_t, 8> seen;
  size_t count = 0;
  for (int i = 0; i < 8; ++i) {
    const uint32_t h = hash(first[0] + (i & 1), first[1] + (i >> 1 & 1), first[2] + (i >> 2));
    const Part& part = parts_[h >> 26];
    const uint32_t in_part = h % cells_per_part_;
    const uint32_t c = (h >> 26) * cells_per_part_ + in_part;
    bool again = false;
    for (size_t k = 0; k < count; ++k) again = again || seen[k] == c;
    if (again || part.photons.empty()) continue;
    seen[count++] = c;
    for (uint32_t k = part.cell_begins[in_part]; k < part.cell_begins[in_part + 1]; ++k) {
      const Photon& photon = part.photons[k];
      const Vec3 d = photon.p - p;
      if (dot(d, d) <= radius * radius) f(photon);
    }
  }
}

}  // namespace etd
