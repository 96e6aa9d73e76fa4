#include "integrators/guiding/direction_tree.h"

#include <algorithm>
#include <cmath>

namespace etd {

namespace {

// Noise of the trees multiplies along a path. So quadrants are cut only where they have photons enough, and keep the
// share that some made-up photons give them (docs/performance.md).
constexpr size_t kFewestPhotons = 20;
constexpr double kMadeUpPhotons = 2;  // in each quadrant
constexpr float kLeastShare = 0.01f;  // of all light, in a quadrant that is cut
constexpr int kLevels = 10;

size_t quadrant_of(uint16_t x, uint16_t y, int level) {
  const int bit = 15 - level;
  return size_t{(x >> bit & 1u) | (y >> bit & 1u) << 1};
}
size_t quadrant_of(const DirectedFlux& light, int level) { return quadrant_of(light.from[0], light.from[1], level); }

}  // namespace

std::array<uint16_t, 2> DirectedFlux::encode(Vec3 w) {
  const Vec2 p = to_octahedral(w);
  const auto to_grid = [](float v) { return static_cast<uint16_t>(std::clamp((v + 1.0f) * 32768.0f, 0.0f, 65535.0f)); };
  return {to_grid(p.x), to_grid(p.y)};
}

uint32_t DirectionTrees::add(std::span<DirectedFlux> light) { return add(light, 1.0f, 0); }

uint32_t DirectionTrees::add(std::span<DirectedFlux> light, float share, int level) {
  std::array<double, 4> flux{};
  for (const DirectedFlux& l : light) flux[quadrant_of(l, level)] += static_cast<double>(l.flux);
  const double all = flux[0] + flux[1] + flux[2] + flux[3];
  const double made_up = kMadeUpPhotons * all / static_cast<double>(light.size());
  const auto index = static_cast<uint32_t>(nodes_.size());
  nodes_.emplace_back();
  std::span<DirectedFlux> left = light;
  for (size_t q = 0; q < 4; ++q) {
    const float part = static_cast<float>((flux[q] + made_up) / (all + 4.0 * made_up));
    const auto end =
        std::partition(left.begin(), left.end(), [&](const auto& l) { return quadrant_of(l, level) == q; });
    const std::span<DirectedFlux> mine(left.begin(), end);
    left = {end, left.end()};
    nodes_[index].share[q] = part;
    if (mine.size() < kFewestPhotons || share * part < kLeastShare || level + 1 == kLevels) continue;
    const uint32_t child = add(mine, share * part, level + 1);
    nodes_[index].child[q] = child;
  }
  return index;
}

// u.x chooses all quadrants: what is left of it, and u.y, place the direction in the last one.
GuidedDirection DirectionTrees::sample(uint32_t root, Vec2 u) const {
  Vec2 corner{-1.0f, -1.0f};
  float size = 2.0f, share = 1.0f;
  for (uint32_t at = root;;) {
    const Node& n = nodes_[at];
    const float two = n.share[0] + n.share[1], three = two + n.share[2];
    const unsigned q = (u.x >= n.share[0]) + (u.x >= two) + (u.x >= three);
    const float below = q == 0 ? 0.0f : q == 1 ? n.share[0] : q == 2 ? two : three;
    u.x = std::min((u.x - below) / n.share[q], kOneMinusEpsilon);
    size *= 0.5f, share *= n.share[q];
    corner = {corner.x + static_cast<float>(q & 1) * size, corner.y + static_cast<float>(q >> 1) * size};
    at = n.child[q];
    if (at == 0) break;
  }
  const Vec3 p = from_octahedral({corner.x + u.x * size, corner.y + u.y * size});
  const float r = length(p);
  return {p / r, share / (size * size) * (r * r * r)};
}

float DirectionTrees::pdf(uint32_t root, Vec3 w) const {
  const auto [a, b] = DirectedFlux::encode(w);
  float share = 1.0f;
  int level = 0;
  for (uint32_t at = root;;) {
    const Node& n = nodes_[at];
    const size_t q = quadrant_of(a, b, level++);
    share *= n.share[q];
    at = n.child[q];
    if (at == 0) break;
  }
  const float r = length(w) / (std::abs(w.x) + std::abs(w.y) + std::abs(w.z));
  return std::ldexp(share, 2 * level - 2) * (r * r * r);
}

}  // namespace etd
