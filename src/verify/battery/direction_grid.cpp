#include "verify/battery/direction_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace etd {

namespace {

constexpr int kThetaRoots = 8, kPhiRoots = 16;
constexpr int kMaxDepth = 48;
// A cell with this many pilots is halved further while they fill less than this share of its width: a lobe much thinner
// than a cell could fall between the nodes of the quadrature.
constexpr size_t kMinCluster = 2;
constexpr double kTightCluster = 0.25;

// x = theta, y = phi. The angle comes from both components, so it is precise near the poles.
Vec3d angles(Vec3 w) {
  return {std::atan2(std::hypot(static_cast<double>(w.x), static_cast<double>(w.y)), static_cast<double>(w.z)),
          std::atan2(static_cast<double>(w.y), static_cast<double>(w.x)), 0.0};
}

size_t root_of(Vec3d a) {
  const int i = std::clamp(static_cast<int>(a.x / kPiD * kThetaRoots), 0, kThetaRoots - 1);
  const int j = std::clamp(static_cast<int>((a.y + kPiD) / (2.0 * kPiD) * kPhiRoots), 0, kPhiRoots - 1);
  return static_cast<size_t>(i * kPhiRoots + j);
}

// Extent of the pilots begin..end along theta and phi, as shares of the box.
std::pair<double, double> relative_spread(const Rect& box, const std::vector<Vec3d>& pilots, size_t begin, size_t end) {
  if (begin == end) return {1.0, 1.0};
  Vec3d low = pilots[begin], high = low;
  for (size_t i = begin; i < end; ++i) {
    low = {std::min(low.x, pilots[i].x), std::min(low.y, pilots[i].y), 0.0};
    high = {std::max(high.x, pilots[i].x), std::max(high.y, pilots[i].y), 0.0};
  }
  return {(high.x - low.x) / (box.x1 - box.x0), (high.y - low.y) / (box.y1 - box.y0)};
}

double middle(const Rect& r, bool theta) { return theta ? 0.5 * (r.x0 + r.x1) : 0.5 * (r.y0 + r.y1); }

}  // namespace

DirectionGrid::DirectionGrid(const std::vector<Vec3>& pilots, size_t max_pilots) {
  std::vector<std::vector<Vec3d>> by_root(kThetaRoots * kPhiRoots);
  for (const Vec3& w : pilots) by_root[root_of(angles(w))].push_back(angles(w));
  for (int i = 0; i < kThetaRoots; ++i) {
    for (int j = 0; j < kPhiRoots; ++j) {
      Node node;
      node.box = {kPiD * i / kThetaRoots, kPiD * (i + 1) / kThetaRoots, 2.0 * kPiD * j / kPhiRoots - kPiD,
                  2.0 * kPiD * (j + 1) / kPhiRoots - kPiD};
      nodes_.push_back(node);
    }
  }
  for (size_t r = 0; r < by_root.size(); ++r) split(r, by_root[r], 0, by_root[r].size(), max_pilots, 0);
}

void DirectionGrid::split(size_t node, std::vector<Vec3d>& pilots, size_t begin, size_t end, size_t max_pilots,
                          int depth) {
  const Rect box = nodes_[node].box;
  const auto [spread_theta, spread_phi] = relative_spread(box, pilots, begin, end);
  const bool crowded = end - begin > max_pilots;
  const bool clustered = end - begin >= kMinCluster && std::min(spread_theta, spread_phi) < kTightCluster;
  if (!(crowded || clustered) || depth == kMaxDepth) {
    nodes_[node].cell = cells_.size();
    cells_.push_back(box);
    return;
  }
  const bool similar = std::max(spread_theta, spread_phi) < 2.0 * std::min(spread_theta, spread_phi);
  const bool theta = similar ? depth % 2 == 0 : spread_theta < spread_phi;
  const double m = middle(box, theta);
  const size_t first_child = nodes_.size();
  nodes_[node].splits_theta = theta;
  nodes_[node].first_child = static_cast<int>(first_child);
  Node low, high;
  low.box = high.box = box;
  (theta ? low.box.x1 : low.box.y1) = m;
  (theta ? high.box.x0 : high.box.y0) = m;
  nodes_.push_back(low);
  nodes_.push_back(high);
  const auto first = pilots.begin();
  const auto cut = std::partition(first + static_cast<ptrdiff_t>(begin), first + static_cast<ptrdiff_t>(end),
                                  [&](const Vec3d& a) { return (theta ? a.x : a.y) < m; });
  const size_t between = static_cast<size_t>(cut - first);
  split(first_child, pilots, begin, between, max_pilots, depth + 1);
  split(first_child + 1, pilots, between, end, max_pilots, depth + 1);
}

size_t DirectionGrid::find(Vec3 w) const {
  const Vec3d a = angles(w);
  size_t n = root_of(a);
  while (nodes_[n].first_child >= 0) {
    const bool theta = nodes_[n].splits_theta;
    const bool high = (theta ? a.x : a.y) >= middle(nodes_[n].box, theta);
    n = static_cast<size_t>(nodes_[n].first_child) + (high ? 1 : 0);
  }
  return nodes_[n].cell;
}

std::array<double, 4> DirectionGrid::integrate(size_t i, const std::function<std::array<double, 4>(Vec3)>& f,
                                               double absolute, int splits) const {
  const auto integrand = [&f](double theta, double phi) {
    const double s = std::sin(theta);
    std::array<double, 4> v = f(to_float(Vec3d{s * std::cos(phi), s * std::sin(phi), std::cos(theta)}));
    for (double& x : v) x *= s;
    return v;
  };
  return integrate_rect<4>(integrand, cells_[i], absolute, 1e-3, splits);
}

std::string DirectionGrid::describe_worst(const std::vector<double>& observed,
                                          const std::vector<double>& expected) const {
  const auto z_score = [](double o, double e) { return (o - e) / std::sqrt(std::max(e, 1.0)); };
  std::vector<double> root_observed(kThetaRoots * kPhiRoots), root_expected(kThetaRoots * kPhiRoots);
  for (size_t i = 0; i < cells_.size(); ++i) {
    const size_t root = root_of({0.5 * (cells_[i].x0 + cells_[i].x1), 0.5 * (cells_[i].y0 + cells_[i].y1), 0.0});
    root_observed[root] += observed[i];
    root_expected[root] += expected[i];
  }
  std::string text = "  theta 0 to 180 down, phi -180 to 180 right: + # more, - = fewer than expected\n";
  for (int i = 0; i < kThetaRoots; ++i) {
    text += "  |";
    for (int j = 0; j < kPhiRoots; ++j) {
      const size_t root = static_cast<size_t>(i * kPhiRoots + j);
      const double z = z_score(root_observed[root], root_expected[root]);
      text += std::abs(z) < 3.0 ? (root_expected[root] >= 1.0 ? '.' : ' ')
                                : (z > 5.0 ? '#' : (z > 0.0 ? '+' : (z < -5.0 ? '=' : '-')));
    }
    text += "|\n";
  }

  std::vector<size_t> order(cells_.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return std::abs(z_score(observed[a], expected[a])) > std::abs(z_score(observed[b], expected[b]));
  });
  order.resize(std::min<size_t>(order.size(), 6));
  constexpr double kDegrees = 180.0 / kPiD;
  for (size_t i : order) {
    const Rect& r = cells_[i];
    text += fmt::format(
        "  theta {:8.4f} to {:8.4f}, phi {:9.4f} to {:9.4f}: observed {:8}, expected {:10.2f}, {:+.1f} sigma\n",
        r.x0 * kDegrees, r.x1 * kDegrees, r.y0 * kDegrees, r.y1 * kDegrees, observed[i], expected[i],
        z_score(observed[i], expected[i]));
  }
  return text;
}

CheckMap DirectionGrid::map(const std::vector<double>& observed, const std::vector<double>& expected) const {
  CheckMap map;
  map.width = 360, map.height = 180;
  map.axes = "theta from 0 (+z) down to 180 degrees, phi from -180 to 180 to the right";
  for (int row = 0; row < map.height; ++row)
    for (int column = 0; column < map.width; ++column) {
      const double theta = (row + 0.5) / map.height * kPiD, phi = ((column + 0.5) / map.width * 2.0 - 1.0) * kPiD;
      const double s = std::sin(theta);
      const size_t i = find(to_float(Vec3d{s * std::cos(phi), s * std::sin(phi), std::cos(theta)}));
      const Rect& r = cells_[i];
      const double solid_angle = (std::cos(r.x0) - std::cos(r.x1)) * (r.y1 - r.y0);
      map.sampled.push_back(static_cast<float>(observed[i] / solid_angle));
      map.expected.push_back(static_cast<float>(expected[i] / solid_angle));
      map.sigmas.push_back(static_cast<float>((observed[i] - expected[i]) / std::sqrt(std::max(expected[i], 1.0))));
    }
  return map;
}

}  // namespace etd
