// A tree over the bounds of many lights, down which one of them is chosen by what each branch may bring to a receiver
// (Conty Estevez and Kulla 2018). A node takes 32 bytes and lies beside its sibling in one line of the cache.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lights/light_bounds.h"

namespace etd {

struct LightReceiver;
struct LightChoice;

class LightTree {
 public:
  // A light of the tree: its bounds, which emit something, and its number among all lights.
  struct Item {
    LightBounds bounds;
    uint32_t light = 0;
  };

  LightTree() = default;
  // `lights`: how many there are in all. The tree does not depend on the number of threads that build it.
  LightTree(std::vector<Item> items, size_t lights);

  bool empty() const { return trails_.empty(); }
  // Whether any light of the tree may reach the receiver, as far as the bounds of all together can tell.
  bool may_reach(const LightReceiver& receiver) const;
  // Takes u in [0, 1) with all the bits of a double. Nothing when no light can reach the receiver.
  std::optional<LightChoice> choose(double u, const LightReceiver& receiver) const;
  // The probability with which choose() gives the light, to the last bit; 0 of a light that is not in the tree.
  float probability(uint32_t light, const LightReceiver& receiver) const;
  size_t bytes() const { return pairs_.size() * sizeof(Pair) + trails_.size() * sizeof(uint64_t); }

 private:
  friend class LightTreeBuilder;

  // The lights are within a ball, which serves the bounds of distance and of both angles.
  struct Node {
    Point3 center;
    float radius = 0;
    int16_t axis[3] = {0, 0, 0};   // unit length is kUnitAxis
    uint8_t spread = 0, fall = 0;  // in steps of pi / kSteps, rounded up
    float intensity = 0;           // share of that of all lights, at least kLeastIntensity
    uint32_t index : 30 = 0;       // of the pair of children, or of the light
    uint32_t both : 1 = 0;         // the cone is open on both sides
    uint32_t is_leaf : 1 = 0;
  };
  struct alignas(64) Pair {
    Node child[2];
  };
  struct Direction {
    float cos, sin;
  };

  static constexpr int kSteps = 254;
  static constexpr float kUnitAxis = 32767.0f;
  static constexpr float kLeastIntensity = 1e-12f;
  static constexpr uint64_t kNowhere = ~uint64_t{0};

  static const std::array<Direction, kSteps + 1>& directions();

  // About the irradiance that the node's lights may bring, in units of the tree; 0 only where they can bring none.
  float importance(const Node& node, const LightReceiver& receiver) const;
  // The probability of the first child; nothing when neither can reach the receiver.
  std::optional<float> first_share(const Pair& pair, const LightReceiver& receiver) const;

  Node root_;
  std::vector<Pair> pairs_;
  std::vector<uint64_t> trails_;  // of each light: which child to take, from the lowest bit on; kNowhere: in no leaf
  float scale_ = 1;               // 1 / the length of the scene's lights
  const Direction* directions_ = nullptr;
};

}  // namespace etd
