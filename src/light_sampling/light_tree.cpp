#include "light_sampling/light_tree.h"

#include "light_sampling/light_sampler.h"

namespace etd {

namespace {

// The bounds of angles are of the geometric normal, but the cosine is that of the shading normal: a light near the
// horizon is worth a little more than nothing.
constexpr float kLeastCosine = 0.05f;
// Cosines as far beyond the horizon as rounding takes them still count.
constexpr float kSlack = 1e-3f;
// Each of two children that may bring light is taken at least so often, however the bounds compare them.
constexpr float kLeastShare = 0x1p-14f;
constexpr float kLeastDistance2 = 1e-14f, kMostDistance2 = 1e14f;

// The cosine of the angle a - b, or 1 where b is larger; both in [0, pi].
float cos_of_difference(float cos_a, float sin_a, float cos_b, float sin_b) {
  return cos_a > cos_b ? 1.0f : cos_a * cos_b + sin_a * sin_b;
}

}  // namespace

const std::array<LightTree::Direction, LightTree::kSteps + 1>& LightTree::directions() {
  static const auto all = [] {
    std::array<Direction, kSteps + 1> d;
    for (int i = 0; i <= kSteps; ++i) {
      const double angle = kPiD * i / kSteps;
      d[static_cast<size_t>(i)] = {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
    }
    d[kSteps] = {-1.0f, 0.0f};
    return d;
  }();
  return all;
}

// Conty Estevez and Kulla 2018, equation 3: the light's cosine is bounded by the angle from its axis less the spread of
// its cone and the angle under which its ball is seen; the receiver's by that from the normal less that of the ball.
float LightTree::importance(const Node& node, const LightReceiver& receiver) const {
  const Vec3 d = (node.center - receiver.p) * scale_;
  const float d2 = dot(d, d), r2 = sqr(node.radius);
  float cosines = 1.0f;
  if (d2 > r2) {
    const float inverse = 1.0f / std::sqrt(d2);
    const float sin_ball = node.radius * inverse, cos_ball = safe_sqrt(1.0f - sqr(sin_ball));

    const Vec3 axis{static_cast<float>(node.axis[0]), static_cast<float>(node.axis[1]),
                    static_cast<float>(node.axis[2])};
    float cos_axis = clamp(dot(axis, d) * (-inverse / kUnitAxis), -1.0f, 1.0f);
    if (node.both) cos_axis = std::abs(cos_axis);
    const float sin_axis = safe_sqrt(1.0f - sqr(cos_axis));
    const Direction spread = directions_[node.spread];
    const float cos_beyond = cos_of_difference(cos_axis, sin_axis, spread.cos, spread.sin);
    const float sin_beyond = cos_axis > spread.cos ? 0.0f : sin_axis * spread.cos - cos_axis * spread.sin;
    const float emitted = cos_of_difference(cos_beyond, sin_beyond, cos_ball, sin_ball);
    if (emitted < directions_[node.fall].cos - kSlack) return 0.0f;

    float cos_normal = clamp(dot(receiver.n, d) * inverse, -1.0f, 1.0f);
    if (receiver.both_sides) cos_normal = std::abs(cos_normal);
    const float received = cos_of_difference(cos_normal, safe_sqrt(1.0f - sqr(cos_normal)), cos_ball, sin_ball);
    if (received < -kSlack) return 0.0f;
    cosines = std::max(emitted, kLeastCosine) * std::max(received, kLeastCosine);
  }
  return node.intensity * cosines / clamp(std::max(d2, r2), kLeastDistance2, kMostDistance2);
}

std::optional<float> LightTree::first_share(const Pair& pair, const LightReceiver& receiver) const {
  const float a = importance(pair.child[0], receiver), b = importance(pair.child[1], receiver);
  if (!(a > 0.0f)) return b > 0.0f ? std::optional(0.0f) : std::nullopt;
  if (!(b > 0.0f)) return 1.0f;
  return clamp(a / (a + b), kLeastShare, 1.0f - kLeastShare);
}

bool LightTree::may_reach(const LightReceiver& receiver) const { return importance(root_, receiver) > 0.0f; }

std::optional<LightChoice> LightTree::choose(double u, const LightReceiver& receiver) const {
  const Node* node = &root_;
  float p = 1.0f;
  while (!node->is_leaf) {
    const Pair& pair = pairs_[node->index];
    for (const Node& child : pair.child)
      if (!child.is_leaf) __builtin_prefetch(&pairs_[child.index]);
    const std::optional<float> share = first_share(pair, receiver);
    if (!share) return {};
    const auto first = static_cast<double>(*share);
    const bool second = u >= first;
    u = std::min(second ? (u - first) / (1.0 - first) : u / first, 1.0 - 0x1p-53);
    p *= second ? 1.0f - *share : *share;
    node = &pair.child[second];
  }
  return LightChoice{node->index, p};
}

float LightTree::probability(uint32_t light, const LightReceiver& receiver) const {
  if (empty()) return 0.0f;
  uint64_t trail = trails_[light];
  if (trail == kNowhere) return 0.0f;
  const Node* node = &root_;
  float p = 1.0f;
  for (; !node->is_leaf && p > 0.0f; trail >>= 1) {
    const Pair& pair = pairs_[node->index];
    const std::optional<float> share = first_share(pair, receiver);
    if (!share) return 0.0f;
    p *= trail & 1 ? 1.0f - *share : *share;
    node = &pair.child[trail & 1];
  }
  return p;
}

}  // namespace etd
