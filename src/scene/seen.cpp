#include "scene/seen.h"

#include <algorithm>
#include <vector>

#include "core/hash.h"

namespace etd {

namespace {

constexpr int kSide = 16;       // of the grid of rays
constexpr float kShare = 0.8f;  // of the points that are in the ball: those near the horizon are not
constexpr float kRoom = 1.5f;   // around these, for what lies between them

// The value at this share of the sorted values.
float quantile(std::vector<float> values, float share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<float>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

BoundingSphere seen_by_camera(const Scene& scene, int width, int height) {
  std::vector<Point3> points;
  HashStream random(2);
  for (int i = 0; i < kSide * kSide; ++i) {
    const auto share = [](int k) { return (static_cast<float>(k) + 0.5f) / kSide; };
    const CameraSample at{{share(i % kSide) * static_cast<float>(width), share(i / kSide) * static_cast<float>(height)},
                          {0.5f, 0.5f},
                          random.next_float()};
    Hit hit;
    if (scene.intersect(scene.camera.generate_ray(at), hit)) points.push_back(scene.surface(hit).point.p);
  }
  BoundingSphere seen;
  if (points.empty()) return seen;
  std::vector<float> values(points.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(points.begin(), points.end(), values.begin(), [axis](const Point3& p) { return p[axis]; });
    seen.center[axis] = quantile(values, 0.5f);
  }
  std::transform(points.begin(), points.end(), values.begin(),
                 [&](const Point3& p) { return length(p - seen.center); });
  seen.radius = kRoom * quantile(values, kShare);
  return seen;
}

}  // namespace etd
