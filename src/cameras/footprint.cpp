#include "cameras/footprint.h"

#include "core/frame.h"

namespace etd {

float PixelFootprint::scale_for(uint32_t spp) {
  return std::clamp(1.0f / std::sqrt(static_cast<float>(std::max(spp, 1u))), 0.125f, 1.0f);
}

PixelFootprint::PixelFootprint(const Camera& camera, int width, int height, float scale) {
  constexpr int kAcross = 16;  // places along each side of the film
  const auto ray = [&](float x, float y) { return camera.generate_ray({{x, y}, {0.5f, 0.5f}, 0.5f}); };
  const auto w = static_cast<float>(width), h = static_cast<float>(height);
  x_ = y_ = {kInfinity, kInfinity};
  const auto shrink = [](Change& change, const Ray& a, const Ray& b) {
    change.origin = std::min(change.origin, length(b.o - a.o));
    change.direction = std::min(change.direction, length(normalize(b.d) - normalize(a.d)));
  };
  for (int i = 0; i < kAcross; ++i)
    for (int j = 0; j < kAcross; ++j) {
      const float x = (static_cast<float>(i) + 0.5f) / kAcross * w, y = (static_cast<float>(j) + 0.5f) / kAcross * h;
      shrink(x_, ray(x - 0.5f, y), ray(x + 0.5f, y));
      shrink(y_, ray(x, y - 0.5f), ray(x, y + 0.5f));
    }
  const Ray middle = ray(0.5f * w, 0.5f * h), beside = ray(0.5f * w + 1, 0.5f * h);
  constexpr float kNoAngle = 1e-7f;
  parallel_ = x_.direction < kNoAngle && y_.direction < kNoAngle && x_.origin > 0.0f;
  origin_ = middle.o;
  axis_ = normalize(middle.d);
  right_ = (beside.o - middle.o) + (normalize(beside.d) - axis_);
  for (Change* c : {&x_, &y_}) {
    c->origin *= scale;
    c->direction *= scale;
  }
}

PixelFootprint::Step PixelFootprint::at(Point3 p, Vec3 n) const {
  const Vec3 way = p - origin_;
  const float distance = length(way);
  if (!(distance > 0.0f && std::isfinite(distance))) return {};
  const Vec3 w = parallel_ ? axis_ : way * (1.0f / distance);
  // The film's axes, turned to be across the ray.
  const Frame film = Frame::from_z_tangent(w, right_);
  const Vec3 dx = film.x * (x_.origin + distance * x_.direction);
  const Vec3 dy = film.y * (y_.origin + distance * y_.direction);
  // The steps are projected along the ray onto the tangent plane.
  constexpr float kEdgeOn = 1e-3f;
  const float cosine = dot(n, w), divisor = std::copysign(std::max(std::abs(cosine), kEdgeOn), cosine);
  return {dx - w * (dot(n, dx) / divisor), dy - w * (dot(n, dy) / divisor)};
}

}  // namespace etd
