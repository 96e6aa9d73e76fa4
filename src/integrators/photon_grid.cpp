#include "integrators/photon_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/hash.h"

namespace etd {

namespace {

constexpr float kGrid = 32767.0f;

int16_t to_grid(float v) { return static_cast<int16_t>(std::lround(std::clamp(v, -1.0f, 1.0f) * kGrid)); }

uint32_t part_of(uint32_t hash) { return hash >> 26; }
static_assert(PhotonGrid::kParts == 64, "parts are the upper six bits of the hash");

}  // namespace

// The octahedron unfolded (Cigolle et al. 2014).
std::array<int16_t, 2> Photon::encode(Vec3 w) {
  const float sum = std::abs(w.x) + std::abs(w.y) + std::abs(w.z);
  float a = w.x / sum, b = w.y / sum;
  if (w.z < 0.0f) {
    const float folded = std::copysign(1.0f - std::abs(b), a);
    b = std::copysign(1.0f - std::abs(a), b);
    a = folded;
  }
  return {to_grid(a), to_grid(b)};
}

Vec3 Photon::direction() const {
  float a = static_cast<float>(from[0]) / kGrid, b = static_cast<float>(from[1]) / kGrid;
  const float z = 1.0f - std::abs(a) - std::abs(b);
  if (z < 0.0f) {
    const float folded = std::copysign(1.0f - std::abs(b), a);
    b = std::copysign(1.0f - std::abs(a), b);
    a = folded;
  }
  return normalize(Vec3{a, b, z});
}

void PhotonGrid::start(size_t items, float width) {
  width_ = static_cast<double>(width);
  photon_count_ = 0;
  items_.resize(items);
  for (Item& item : items_) item.photons.clear();
  for (Part& part : parts_) part.photons.clear();
}

std::array<int64_t, 3> PhotonGrid::cube(Point3 p, double shift) const {
  std::array<int64_t, 3> c;
  for (int i = 0; i < 3; ++i)
    c[static_cast<size_t>(i)] = static_cast<int64_t>(std::floor(static_cast<double>(p[i]) / width_ + shift));
  return c;
}

uint32_t PhotonGrid::hash(int64_t x, int64_t y, int64_t z) const {
  return static_cast<uint32_t>(
      hash_combine(static_cast<uint64_t>(x), static_cast<uint64_t>(y), static_cast<uint64_t>(z)) >> 32);
}

void PhotonGrid::finish_item(size_t index) {
  Item& item = items_[index];
  std::vector<uint32_t> hashes;
  hashes.reserve(item.photons.size());
  item.parts.fill(0);
  for (const Photon& photon : item.photons) {
    const std::array<int64_t, 3> c = cube(photon.p, 0.0);
    hashes.push_back(hash(c[0], c[1], c[2]));
    ++item.parts[part_of(hashes.back()) + 1];
  }
  for (size_t part = 0; part < kParts; ++part) item.parts[part + 1] += item.parts[part];
  // A stable sort, so that the order depends on the photons alone.
  std::vector<Photon> sorted(item.photons.size());
  item.hashes.resize(item.photons.size());
  std::array<uint32_t, kParts + 1> next = item.parts;
  for (size_t i = 0; i < hashes.size(); ++i) {
    const uint32_t to = next[part_of(hashes[i])]++;
    sorted[to] = item.photons[i];
    item.hashes[to] = hashes[i];
  }
  item.photons = std::move(sorted);
}

void PhotonGrid::begin_build() {
  for (const Item& item : items_) photon_count_ += item.photons.size();
  cells_per_part_ = static_cast<uint32_t>(std::bit_ceil(std::max<size_t>(photon_count_ / kParts, 1)));
}

void PhotonGrid::build(size_t index) {
  Part& part = parts_[index];
  part.cell_begins.assign(cells_per_part_ + 1, 0);
  const auto for_all = [&](auto&& f) {
    for (const Item& item : items_)
      for (uint32_t i = item.parts[index]; i < item.parts[index + 1]; ++i) f(item, i, item.hashes[i] % cells_per_part_);
  };
  size_t count = 0;
  for_all([&](const Item&, uint32_t, uint32_t cell) { ++part.cell_begins[cell + 1], ++count; });
  for (uint32_t cell = 0; cell < cells_per_part_; ++cell) part.cell_begins[cell + 1] += part.cell_begins[cell];
  part.photons.resize(count);
  std::vector<uint32_t> next(part.cell_begins.begin(), part.cell_begins.end() - 1);
  for_all([&](const Item& item, uint32_t i, uint32_t cell) { part.photons[next[cell]++] = item.photons[i]; });
}

}  // namespace etd
