#include "io/polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace etd {

namespace {

constexpr double kRounding = 1e-15;  // of positions in the plane, whose size is 1
constexpr size_t kLeafCorners = 8;
constexpr uint32_t kNoLeaf = std::numeric_limits<uint32_t>::max();

struct Plane {
  Vec3d u, v;
};

// Perpendicular to a unit vector (Duff et al. 2017, "Building an Orthonormal Basis, Revisited"); exact along an axis.
Plane plane_of(Vec3d n) {
  const double sign = std::copysign(1.0, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
  return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}};
}

// Half the plane of directions: a turn to the left by less than 180 degrees enters the upper half once each time round.
bool is_upper(double dx, double dy) { return dy > 0 || (dy == 0 && dx > 0); }

}  // namespace

bool PolygonCutter::cut(const std::vector<Point3d>& positions, std::span<const uint32_t> corners,
                        std::vector<std::array<uint32_t, 3>>& triangles) {
  const auto count = static_cast<uint32_t>(corners.size());
  Outline shape = Outline::kConvex;
  if (count > 3 && project(positions, corners)) shape = outline();
  if (shape == Outline::kConvex) {
    for (uint32_t i = 2; i < count; ++i) triangles.push_back({corners[0], corners[i - 1], corners[i]});
    return true;
  }
  const bool crosses = shape == Outline::kTwisted || edges_cross();
  build_tree();
  for (size_t level = 0; level < kLevels; ++level) waiting_[level].clear(), first_[level] = 0;
  for (uint32_t i = 0; i < count; ++i) waiting_[kSpike].push_back({i, corners_[i].changes});
  double negative = 0;
  Level level;
  uint32_t c;
  for (uint32_t left = count; left > 2 && next_candidate(level, c);) {
    if (!allows(c, level)) {
      waiting_[level + 1].push_back({c, corners_[c].changes});
      continue;
    }
    const uint32_t prev = corners_[c].prev, next = corners_[c].next;
    if (level != kSpike && level != kFlat) triangles.push_back({corners[prev], corners[c], corners[next]});
    negative += std::max(0.0, -triangle_at(c).area());
    set_reflex(c, false);
    ++corners_[c].changes;
    corners_[prev].next = next, corners_[next].prev = prev;
    --left;
    for (const uint32_t neighbour : {prev, next}) {
      set_reflex(neighbour, turn(neighbour) <= 0);
      waiting_[kSpike].push_back({neighbour, ++corners_[neighbour].changes});
    }
  }
  return !crosses && negative <= 4 * tolerance_;
}

// False: the corners lie on a line.
bool PolygonCutter::project(const std::vector<Point3d>& positions, std::span<const uint32_t> corners) {
  const size_t count = corners.size();
  const Point3d origin = positions[corners[0]];
  double size = 0;
  for (const uint32_t c : corners) size = std::max(size, max_component(abs(positions[c] - origin)));
  if (size == 0) return false;
  // A power of two: it rounds nothing.
  int exponent;
  std::frexp(size, &exponent);
  const double scale = std::ldexp(1.0, -std::max(exponent, -1022));
  const auto at = [&](size_t i) { return (positions[corners[i]] - origin) * scale; };

  Vec3d normal, largest;
  double sum = 0;
  for (size_t i = 2; i < count; ++i) {
    const Vec3d n = cross(at(i - 1), at(i));
    if (dot(n, n) > dot(largest, largest)) largest = n;
    normal += n;
    sum += length(n);
  }
  // Newell's normal, unless the parts of the polygon cancel.
  if (length(normal) < 1e-9 * sum) normal = largest;
  if (!(length(normal) > 0)) return false;
  const Plane plane = plane_of(normalize(normal));
  corners_.resize(count);
  for (size_t i = 0; i < count; ++i) {
    const Vec3d p = at(i);
    const auto prev = static_cast<uint32_t>(i == 0 ? count - 1 : i - 1);
    const auto next = static_cast<uint32_t>(i + 1 == count ? 0 : i + 1);
    corners_[i] = {dot(plane.u, p), dot(plane.v, p), prev, next};
  }
  const double farthest = max_component(abs(origin - Point3d())) * scale;
  tolerance_ = std::ldexp(std::max(1.0, farthest), -21);
  return true;
}

PolygonCutter::Edge PolygonCutter::edge(uint32_t from, uint32_t to) const {
  const Corner &a = corners_[from], &b = corners_[to];
  return {a.x, a.y, b.x - a.x, b.y - a.y};
}

PolygonCutter::Triangle PolygonCutter::triangle_at(uint32_t c) const {
  const uint32_t prev = corners_[c].prev, next = corners_[c].next;
  Triangle t{{edge(prev, c), edge(c, next), edge(next, prev)}, 0, {}, {}};
  for (const Edge& e : t.edges) t.noise += kRounding * (std::abs(e.dx) + std::abs(e.dy));
  const auto [low_x, high_x] = std::minmax({corners_[prev].x, corners_[c].x, corners_[next].x});
  const auto [low_y, high_y] = std::minmax({corners_[prev].y, corners_[c].y, corners_[next].y});
  t.low[0] = low_x, t.low[1] = low_y, t.high[0] = high_x, t.high[1] = high_y;
  return t;
}

int PolygonCutter::turn(uint32_t corner) const {
  const Triangle t = triangle_at(corner);
  const double area = t.area();
  return area > t.noise ? 1 : area < -t.noise ? -1 : 0;
}

// Judges the outline by the sum of its turns, which is 360 degrees unless it is twisted; spikes may turn either way.
PolygonCutter::Outline PolygonCutter::outline() const {
  int rounds = 0;
  bool convex = true, spikes = false;
  for (uint32_t i = 0; i < corners_.size(); ++i) {
    const Edge before = edge(corners_[i].prev, i), behind = edge(i, corners_[i].next);
    const double left = before.dx * behind.dy - before.dy * behind.dx;
    const bool was_upper = is_upper(before.dx, before.dy), upper = is_upper(behind.dx, behind.dy);
    if (was_upper != upper) rounds += left > 0 && upper ? 1 : left < 0 && !upper ? -1 : 0;
    convex = convex && turn(i) > 0;
    spikes = spikes || is_spike(i);
  }
  if (rounds != 1 && !spikes) return Outline::kTwisted;
  return convex && rounds == 1 ? Outline::kConvex : Outline::kOther;
}

// The edges at the corner run back on each other, or have no length.
bool PolygonCutter::is_spike(uint32_t corner) const {
  const Edge before = edge(corners_[corner].prev, corner), behind = edge(corner, corners_[corner].next);
  return before.dx * behind.dx + before.dy * behind.dy <= 0 && turn(corner) == 0;
}

// Whether two edges cross, from left to right through the polygon, by more than what rounding explains. Where that
// would compare too many pairs, only negative triangles tell.
bool PolygonCutter::edges_cross() {
  const auto low = [this](uint32_t e) { return std::min(corners_[e].x, corners_[corners_[e].next].x); };
  const auto high = [this](uint32_t e) { return std::max(corners_[e].x, corners_[corners_[e].next].x); };
  const auto apart = [this](const Edge& e, const Edge& f) {
    const double clear = tolerance_ * (std::abs(e.dx) + std::abs(e.dy));
    const double begin = e.side(f.x, f.y), end = e.side(f.x + f.dx, f.y + f.dy);
    return std::max(begin, end) > clear && std::min(begin, end) < -clear;
  };
  std::vector<uint32_t>& order = in_tree_;
  order.resize(corners_.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return low(a) < low(b); });
  size_t pairs = 256 * order.size();
  for (size_t i = 0; i < order.size(); ++i) {
    const Edge e = edge(order[i], corners_[order[i]].next);
    const double end = high(order[i]);
    for (size_t k = i + 1; k < order.size() && low(order[k]) <= end; ++k) {
      if (pairs-- == 0) return false;
      const Edge f = edge(order[k], corners_[order[k]].next);
      if (apart(e, f) && apart(f, e)) return true;
    }
  }
  return false;
}

void PolygonCutter::build_tree() {
  in_tree_.clear();
  for (uint32_t i = 0; i < corners_.size(); ++i) {
    corners_[i].reflex = turn(i) <= 0;
    if (corners_[i].reflex) in_tree_.push_back(i);
  }
  leaf_of_.assign(corners_.size(), kNoLeaf);
  size_t leaves = 1;
  while (leaves * kLeafCorners < in_tree_.size()) leaves *= 2;
  nodes_.resize(in_tree_.empty() ? 0 : 2 * leaves - 1);
  if (!nodes_.empty()) build_node(0, 0, in_tree_.size());
}

void PolygonCutter::build_node(size_t node, size_t begin, size_t end) {
  Node& n = nodes_[node];
  n = {{1e300, 1e300}, {-1e300, -1e300}, static_cast<uint32_t>(end - begin)};
  for (size_t i = begin; i < end; ++i) {
    const Corner& c = corners_[in_tree_[i]];
    n.low[0] = std::min(n.low[0], c.x), n.low[1] = std::min(n.low[1], c.y);
    n.high[0] = std::max(n.high[0], c.x), n.high[1] = std::max(n.high[1], c.y);
  }
  if (node >= nodes_.size() / 2) {
    for (size_t i = begin; i < end; ++i) leaf_of_[in_tree_[i]] = static_cast<uint32_t>(node);
    return;
  }
  const bool along_x = n.high[0] - n.low[0] > n.high[1] - n.low[1];
  const size_t middle = (begin + end) / 2;
  const auto at = [this](size_t i) { return in_tree_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](uint32_t a, uint32_t b) {
    return along_x ? corners_[a].x < corners_[b].x : corners_[a].y < corners_[b].y;
  });
  build_node(2 * node + 1, begin, middle);
  build_node(2 * node + 2, middle, end);
}

// Corners at the same place as one of the triangle's own lie on two of its edges, and are not in it.
bool PolygonCutter::holds_corner(const Triangle& t, bool with_cut, size_t node, size_t begin, size_t end) const {
  if (nodes_.empty() || nodes_[node].left == 0) return false;
  const Node& n = nodes_[node];
  for (int axis = 0; axis < 2; ++axis)
    if (n.high[axis] < t.low[axis] || n.low[axis] > t.high[axis]) return false;
  bool all = true;
  for (size_t k = 0; k < 3; ++k) {
    const Edge& e = t.edges[k];
    const double least = k == 2 && with_cut ? -t.noise : t.noise;
    if (e.side(e.dy > 0 ? n.low[0] : n.high[0], e.dx > 0 ? n.high[1] : n.low[1]) <= least) return false;
    all = all && e.side(e.dy > 0 ? n.high[0] : n.low[0], e.dx > 0 ? n.low[1] : n.high[1]) > least;
  }
  if (all) return true;
  if (node < nodes_.size() / 2) {
    const size_t middle = (begin + end) / 2;
    return holds_corner(t, with_cut, 2 * node + 1, begin, middle) ||
           holds_corner(t, with_cut, 2 * node + 2, middle, end);
  }
  return std::any_of(in_tree_.begin() + static_cast<std::ptrdiff_t>(begin),
                     in_tree_.begin() + static_cast<std::ptrdiff_t>(end), [&](uint32_t i) {
                       const Corner& c = corners_[i];
                       return c.reflex && t.edges[0].side(c.x, c.y) > t.noise && t.edges[1].side(c.x, c.y) > t.noise &&
                              t.edges[2].side(c.x, c.y) > (with_cut ? -t.noise : t.noise);
                     });
}

bool PolygonCutter::allows(uint32_t corner, Level level) const {
  if (level == kAny) return true;
  if (level == kSpike) return is_spike(corner);
  const int side = turn(corner);
  if (level == kFlat) return side == 0;
  if (side <= 0) return false;
  return level == kConvex || !holds_corner(triangle_at(corner), level == kEar, 0, 0, in_tree_.size());
}

void PolygonCutter::set_reflex(uint32_t corner, bool reflex) {
  if (corners_[corner].reflex == reflex) return;
  corners_[corner].reflex = reflex;
  if (leaf_of_[corner] == kNoLeaf) return;
  for (size_t node = leaf_of_[corner];; node = (node - 1) / 2) {
    nodes_[node].left += reflex ? 1u : ~0u;
    if (node == 0) return;
  }
}

// Whose neighbours are still those that it waits with.
bool PolygonCutter::next_candidate(Level& level, uint32_t& corner) {
  for (int i = 0; i < kLevels; ++i) {
    std::vector<Candidate>& waiting = waiting_[static_cast<size_t>(i)];
    size_t& first = first_[static_cast<size_t>(i)];
    while (first < waiting.size()) {
      const Candidate c = waiting[first++];
      if (corners_[c.corner].changes != c.changes) continue;
      level = static_cast<Level>(i);
      corner = c.corner;
      return true;
    }
    waiting.clear();
    first = 0;
  }
  return false;
}

}  // namespace etd
