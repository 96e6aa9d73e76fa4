// What photons tell of the light at surfaces: an SD-tree (Müller, Gross and Novák 2017), which here is made once,
// before the first sample, and never changes. So samples depend on their own numbers alone, and no light is counted
// that taught where to look for it.
#pragma once

#include <cstdint>
#include <vector>

#include "integrators/guiding/direction_tree.h"

namespace etd {

struct GuidePhoton {
  Point3 p;
  std::array<uint16_t, 2> from;  // DirectedFlux::encode
  float flux;                    // W
  uint8_t side;                  // Guide::side_of the surface
  bool direct;                   // next-event estimation finds this light
};

// What is known of the light in a cell of space, at surfaces of one side.
struct GuideCell {
  const DirectionTrees* trees = nullptr;
  uint32_t root = 0;                   // of the indirect light
  float irradiance = 0, indirect = 0;  // W/m^2, of all light and of the part that next-event estimation does not find

  GuidedDirection sample(Vec2 u) const { return trees->sample(root, u); }
  float pdf(Vec3 w) const { return trees->pdf(root, w); }
};

class Guide {
 public:
  // Photons are kept by item; each may do so while others do.
  void start(size_t items) { items_.assign(items, {}); }
  void add(size_t item, const GuidePhoton& photon) { items_[item].push_back(photon); }
  size_t photons(size_t item) const { return items_[item].size(); }
  void finish_item(size_t item) { items_[item].shrink_to_fit(); }
  // After begin_build(), each of parts() may be built while others are. Then end_build() lets the photons go.
  void begin_build();
  size_t parts() const { return parts_.size(); }
  void build(size_t part);
  void end_build();
  bool built() const { return built_; }

  // Which of six sides of things a surface is on, that look along an axis each.
  static uint8_t side_of(Vec3 normal);
  // Returns what is known at the point of a surface whose normal is on the viewer's side; nullptr: too little.
  const GuideCell* find(Point3 p, Vec3 normal) const;
  size_t bytes() const;

 private:
  static constexpr uint32_t kLeaf = 3;
  struct Node {
    float split = 0;
    uint32_t axis : 2 = kLeaf;
    uint32_t index : 30 = 0;  // of the lower of two children in a row; of a leaf: of the part or cell
  };
  struct Part {
    std::span<GuidePhoton> photons;
    std::vector<Node> nodes;
    std::vector<GuideCell> cells;
    DirectionTrees trees;
  };
  template <class F>
  static void divide(std::vector<Node>& nodes, size_t at, std::span<GuidePhoton> photons, size_t most, const F& leaf);
  static const Node& descend(const std::vector<Node>& nodes, size_t root, Point3 p);
  static GuideCell cell(std::span<const GuidePhoton> photons, DirectionTrees& trees);

  std::vector<std::vector<GuidePhoton>> items_;
  std::vector<GuidePhoton> photons_;
  std::vector<Node> top_;  // the first six are the roots of the sides
  std::vector<Part> parts_;
  bool built_ = false;
};

}  // namespace etd
