// From where light comes at a place: quadtrees over the octahedral square, finer where more light comes from (Müller,
// Gross and Novák 2017, section 3).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math.h"
#include "core/octahedral.h"

namespace etd {

// Light that came from a direction, which is a point of the octahedral square in 16 bits for each axis.
struct DirectedFlux {
  std::array<uint16_t, 2> from;
  float flux;

  static std::array<uint16_t, 2> encode(Vec3 w);
};

struct GuidedDirection {
  Vec3 w;
  float pdf;  // per solid angle
};

// Many trees in one array.
class DirectionTrees {
 public:
  // Makes a tree, reordering the light, and returns its root.
  uint32_t add(std::span<DirectedFlux> light);

  GuidedDirection sample(uint32_t root, Vec2 u) const;
  // Returns the density per solid angle with which sample() finds the direction.
  float pdf(uint32_t root, Vec3 w) const;

  size_t bytes() const { return nodes_.size() * sizeof(Node); }

 private:
  // Quadrants: those of the greater x have bit 0, those of the greater y bit 1.
  struct Node {
    std::array<float, 4> share;     // of the light, which sum up to 1
    std::array<uint32_t, 4> child;  // 0: the light is spread evenly
  };
  uint32_t add(std::span<DirectedFlux> light, float share, int level);

  std::vector<Node> nodes_ = std::vector<Node>(1);
};

}  // namespace etd
