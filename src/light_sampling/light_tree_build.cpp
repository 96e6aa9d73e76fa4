// Builds the tree of lights from the top: each node is cut where the lights of its parts are strong, spread over space
// and over directions as little as possible.
#include <tbb/parallel_invoke.h>

#include <algorithm>

#include "light_sampling/light_tree.h"

namespace etd {

namespace {

constexpr int kBins = 12;
// Below this depth lights are cut into halves, so that trails have no more than 64 turns.
constexpr int kDepthOfCost = 30;
constexpr size_t kParallel = 4096;  // lights from which on the two parts are built at once

// The mean of the directions of a cone that they fill evenly, (1 + cos spread) / 2 long. What is open on both sides is
// taken by one of its axes, the same for all that have it.
Vec3 mean_direction(const DirectionCone& cone) {
  Vec3 axis = cone.axis;
  if (cone.both) {
    const Vec3 a = abs(axis);
    const int largest = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    if (axis[largest] < 0.0f) axis = -axis;
  }
  return axis * (0.5f * (1.0f + std::cos(cone.spread)));
}

// A light, and what each level asks of it.
struct Work {
  LightBounds bounds;
  uint32_t light = 0;
  Point3 center;
  Vec3 direction;  // the mean one times the intensity

  Work() = default;
  explicit Work(const LightTree::Item& i)
      : bounds(i.bounds),
        light(i.light),
        center(to_float(bounds.box.center())),
        direction(mean_direction(bounds.cone) * bounds.intensity) {}
};

// Some lights, as the cost of a cut sees them. The spread of their normals is told by the length of the mean
// direction: unlike the cone around all of them it can be added up.
struct Group {
  Bounds3 box;
  Vec3d direction;  // sum of mean directions, weighed by intensity
  double intensity = 0;
  double fall = 0;
  size_t count = 0;

  void add(const Group& g) {
    if (g.count == 0) return;
    box.extend(g.box.lo);
    box.extend(g.box.hi);
    direction += g.direction;
    intensity += g.intensity;
    fall = std::max(fall, g.fall);
    count += g.count;
  }
  void add(const Work& item) {
    const LightBounds& b = item.bounds;
    add(Group{b.box, to_double(item.direction), static_cast<double>(b.intensity), static_cast<double>(b.fall), 1});
  }

  // Intensity times the measures of space and of directions (Conty Estevez and Kulla 2018, equations 1 and 2, with the
  // surface of the ball instead of that of the box, because the ball is what importance goes by).
  double cost() const {
    const double spread = std::acos(std::clamp(2 * length(direction) / intensity - 1, -1.0, 1.0));
    const double end = std::min(spread + fall, kPiD);
    const double solid_angle =
        2 * kPiD * (1 - std::cos(spread)) + kPiD / 2 *
                                                (2 * end * std::sin(spread) - std::cos(spread - 2 * end) -
                                                 2 * spread * std::sin(spread) + std::cos(spread));
    const Vec3d d = box.diagonal();
    return intensity * solid_angle * dot(d, d);
  }
};

int bin_of(const Work& item, int axis, double lo, double per_length) {
  const double place = (static_cast<double>(item.center[axis]) - lo) * per_length;
  return static_cast<int>(std::clamp(place, 0.0, kBins - 1.0));
}

struct Cut {
  int axis = -1, bin = 0;  // the first bin of the second part
  double lo = 0, per_length = 0;
};

// The cheapest cut of the lights; none where all have one centre.
Cut cheapest_cut(std::span<const Work> items, const Bounds3& centers) {
  std::array<std::array<Group, kBins>, 3> bins;
  const Vec3d size = centers.diagonal();
  const double longest = std::max({size.x, size.y, size.z});
  const auto per_length = [&](int axis) { return kBins / size[axis]; };
  for (const Work& item : items)
    for (int axis = 0; axis < 3; ++axis)
      if (size[axis] > 0)
        bins[static_cast<size_t>(axis)][static_cast<size_t>(bin_of(item, axis, centers.lo[axis], per_length(axis)))]
            .add(item);
  Cut best;
  double least = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (!(size[axis] > 0) || !std::isfinite(per_length(axis))) continue;
    const auto& b = bins[static_cast<size_t>(axis)];
    std::array<Group, kBins> below;  // [i]: of the bins before i
    for (size_t i = 1; i < kBins; ++i) {
      below[i] = below[i - 1];
      below[i].add(b[i - 1]);
    }
    Group above;
    for (size_t i = kBins - 1; i > 0; --i) {
      above.add(b[i]);
      if (above.count == 0 || below[i].count == 0) continue;
      const double cost = (below[i].cost() + above.cost()) * (longest / size[axis]);
      if (cost < least) least = cost, best = {axis, static_cast<int>(i), centers.lo[axis], per_length(axis)};
    }
  }
  return best;
}

// Moves the lights of the first part to the front and returns how many there are.
size_t divide(std::span<Work> items, int depth) {
  Bounds3 centers;
  for (const Work& item : items) centers.extend(to_double(item.center));
  if (depth < kDepthOfCost) {
    const Cut cut = cheapest_cut(items, centers);
    if (cut.axis >= 0) {
      const auto middle = std::partition(items.begin(), items.end(), [&](const Work& item) {
        return bin_of(item, cut.axis, cut.lo, cut.per_length) < cut.bin;
      });
      return static_cast<size_t>(middle - items.begin());
    }
  }
  const Vec3d size = centers.diagonal();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto middle = items.begin() + static_cast<std::ptrdiff_t>(items.size() / 2);
  std::nth_element(items.begin(), middle, items.end(), [axis](const Work& a, const Work& b) {
    return std::pair(a.center[axis], a.light) < std::pair(b.center[axis], b.light);
  });
  return items.size() / 2;
}

uint8_t in_steps(float angle, float steps) {
  // What rounding the axis and cosines may have cost is added.
  return static_cast<uint8_t>(clamp(std::ceil((angle + 1e-4f) * steps / kPi), 0.0f, steps));
}

}  // namespace

class LightTreeBuilder {
 public:
  LightTreeBuilder(LightTree& tree, double intensity) : tree_(tree), intensity_(intensity) {}

  // Makes the node over the lights. Its children and theirs are the pairs from `first` on, one for each light but one.
  LightBounds build(std::span<Work> items, uint32_t first, uint64_t trail, int depth, LightTree::Node& node) {
    if (items.size() == 1) {
      tree_.trails_[items[0].light] = trail;
      set(node, items[0].bounds, items[0].light);
      node.is_leaf = 1;
      return items[0].bounds;
    }
    const size_t count = divide(items, depth);
    LightTree::Pair& pair = tree_.pairs_[first];
    LightBounds a, b;
    const auto build_first = [&] { a = build(items.first(count), first + 1, trail, depth + 1, pair.child[0]); };
    const auto build_second = [&] {
      b = build(items.subspan(count), first + static_cast<uint32_t>(count), trail | uint64_t{1} << depth, depth + 1,
                pair.child[1]);
    };
    if (items.size() >= kParallel)
      tbb::parallel_invoke(build_first, build_second);
    else
      build_first(), build_second();
    const LightBounds both = unite(a, b);
    set(node, both, first);
    return both;
  }

 private:
  void set(LightTree::Node& node, const LightBounds& b, uint32_t index) const {
    node.center = to_float(b.box.center());
    const Point3d center = to_double(node.center);
    double r2 = 0;
    for (int i = 0; i < 8; ++i) {
      const Point3d corner{(i & 1 ? b.box.hi : b.box.lo).x, (i & 2 ? b.box.hi : b.box.lo).y,
                           (i & 4 ? b.box.hi : b.box.lo).z};
      r2 = std::max(r2, dot(corner - center, corner - center));
    }
    node.radius = static_cast<float>(std::sqrt(r2) * (1 + 1e-6)) * tree_.scale_;
    for (int i = 0; i < 3; ++i) node.axis[i] = static_cast<int16_t>(std::lround(b.cone.axis[i] * LightTree::kUnitAxis));
    node.spread = in_steps(b.cone.spread, LightTree::kSteps);
    node.fall = in_steps(b.fall, LightTree::kSteps);
    node.intensity = static_cast<float>(static_cast<double>(b.intensity) / intensity_);
    node.intensity = std::max(node.intensity, LightTree::kLeastIntensity);
    node.index = index & ((1u << 30) - 1);
    node.both = b.cone.both ? 1 : 0;
  }

  LightTree& tree_;
  double intensity_;
};

LightTree::LightTree(std::vector<Item> items, size_t lights) : directions_(directions().data()) {
  if (items.empty()) return;
  Bounds3 all;
  double intensity = 0;
  std::vector<Work> work;
  work.reserve(items.size());
  for (Item& item : items) {
    // A light that emits has some intensity, whatever rounding made of it.
    item.bounds.intensity = std::max(item.bounds.intensity, std::numeric_limits<float>::min());
    work.emplace_back(item);
    all.extend(item.bounds.box.lo);
    all.extend(item.bounds.box.hi);
    intensity += static_cast<double>(item.bounds.intensity);
  }
  const double size = length(all.diagonal());
  scale_ = size > 0 ? static_cast<float>(1.0 / size) : 1.0f;
  if (!std::isfinite(scale_)) scale_ = 1.0f;
  trails_.assign(lights, kNowhere);
  pairs_.resize(items.size() - 1);
  LightTreeBuilder(*this, intensity).build(work, 0, 0, 0, root_);
}

}  // namespace etd
