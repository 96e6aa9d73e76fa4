#include "integrators/guiding/guide.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace etd {

namespace {

constexpr size_t kCellPhotons = 2000;  // at most (docs/performance.md)
constexpr size_t kFewestPhotons = 32;  // that tell of a cell's light
constexpr size_t kSides = 6, kTopParts = 64;

}  // namespace

uint8_t Guide::side_of(Vec3 n) {
  const float x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
  const int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  return static_cast<uint8_t>(2 * axis + (n[axis] < 0.0f ? 1 : 0));
}

// Halves the photons of a node along the longer side until no more than `most` are in one.
template <class F>
void Guide::divide(std::vector<Node>& nodes, size_t at, std::span<GuidePhoton> photons, size_t most, const F& leaf) {
  Point3 lo, hi;
  if (photons.size() > most) {
    lo = hi = photons[0].p;
    for (const GuidePhoton& photon : photons)
      for (int i = 0; i < 3; ++i) lo[i] = std::min(lo[i], photon.p[i]), hi[i] = std::max(hi[i], photon.p[i]);
  }
  const Vec3 d = hi - lo;
  const int axis = d.x >= d.y && d.x >= d.z ? 0 : d.y >= d.z ? 1 : 2;
  if (photons.size() <= most || !(d[axis] > 0.0f)) {
    nodes[at].axis = kLeaf;
    nodes[at].index = leaf(photons) & 0x3fffffffu;
    return;
  }
  const auto middle = photons.begin() + static_cast<std::ptrdiff_t>(photons.size() / 2);
  std::nth_element(photons.begin(), middle, photons.end(),
                   [axis](const auto& a, const auto& b) { return a.p[axis] < b.p[axis]; });
  const size_t child = nodes.size();
  nodes.resize(child + 2);
  nodes[at] = {middle->p[axis], static_cast<uint32_t>(axis) & 3u, static_cast<uint32_t>(child) & 0x3fffffffu};
  divide(nodes, child, {photons.begin(), middle}, most, leaf);
  divide(nodes, child + 1, {middle, photons.end()}, most, leaf);
}

void Guide::begin_build() {
  std::array<size_t, kSides + 1> begins{};
  for (const std::vector<GuidePhoton>& item : items_)
    for (const GuidePhoton& photon : item) ++begins[photon.side + size_t{1}];
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  photons_.resize(begins[kSides]);
  std::array<size_t, kSides + 1> next = begins;
  for (std::vector<GuidePhoton>& item : items_) {
    for (const GuidePhoton& photon : item) photons_[next[photon.side]++] = photon;
    std::vector<GuidePhoton>().swap(item);
  }
  top_.assign(kSides, {});
  const size_t most = std::max(kCellPhotons, photons_.size() / kTopParts);
  for (size_t side = 0; side < kSides; ++side)
    divide(top_, side, std::span(photons_).subspan(begins[side], begins[side + 1] - begins[side]), most,
           [&](std::span<GuidePhoton> photons) {
             parts_.emplace_back().photons = photons;
             return static_cast<uint32_t>(parts_.size() - 1);
           });
}

void Guide::build(size_t index) {
  Part& part = parts_[index];
  part.nodes.assign(1, {});
  divide(part.nodes, 0, part.photons, kCellPhotons, [&](std::span<GuidePhoton> photons) {
    part.cells.push_back(cell(photons, part.trees));
    return static_cast<uint32_t>(part.cells.size() - 1);
  });
}

void Guide::end_build() {
  std::vector<GuidePhoton>().swap(photons_);
  built_ = true;
}

GuideCell Guide::cell(std::span<const GuidePhoton> photons, DirectionTrees& trees) {
  GuideCell c;
  if (photons.size() < kFewestPhotons) return c;
  std::vector<DirectedFlux> light;
  double all = 0, indirect = 0;
  Point3 lo = photons[0].p, hi = lo;
  for (const GuidePhoton& photon : photons) {
    all += static_cast<double>(photon.flux);
    for (int i = 0; i < 3; ++i) lo[i] = std::min(lo[i], photon.p[i]), hi[i] = std::max(hi[i], photon.p[i]);
    if (photon.direct) continue;
    indirect += static_cast<double>(photon.flux);
    light.push_back({photon.from, photon.flux});
  }
  // The surface is about as large as the box of its photons as its side is seen.
  const int axis = photons[0].side / 2;
  const double area = static_cast<double>(hi[(axis + 1) % 3] - lo[(axis + 1) % 3]) *
                      static_cast<double>(hi[(axis + 2) % 3] - lo[(axis + 2) % 3]);
  if (!(area > 0.0) || light.size() < kFewestPhotons) return c;
  c.irradiance = static_cast<float>(all / area), c.indirect = static_cast<float>(indirect / area);
  // What a float cannot hold, in scenes of extreme scale, is not known.
  if (!(c.irradiance > 0.0f && std::isfinite(c.irradiance))) return c;
  c.trees = &trees;
  c.root = trees.add(light);
  return c;
}

const Guide::Node& Guide::descend(const std::vector<Node>& nodes, size_t root, Point3 p) {
  const Node* node = &nodes[root];
  while (node->axis != kLeaf) node = &nodes[node->index + (p[static_cast<int>(node->axis)] < node->split ? 0u : 1u)];
  return *node;
}

const GuideCell* Guide::find(Point3 p, Vec3 normal) const {
  const Part& part = parts_[descend(top_, side_of(normal), p).index];
  const GuideCell& cell = part.cells[descend(part.nodes, 0, p).index];
  return cell.trees ? &cell : nullptr;
}

size_t Guide::bytes() const {
  size_t all = photons_.capacity() * sizeof(GuidePhoton) + top_.capacity() * sizeof(Node);
  for (const auto& item : items_) all += item.capacity() * sizeof(GuidePhoton);
  for (const Part& part : parts_)
    all += part.nodes.capacity() * sizeof(Node) + part.cells.capacity() * sizeof(GuideCell) + part.trees.bytes();
  return all;
}

}  // namespace etd
