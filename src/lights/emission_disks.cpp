#include "lights/emission_disks.h"

#include "core/frame.h"
#include "core/warp.h"

namespace etd {

namespace {
constexpr float kRatio = 4.0f;  // of the radius of a disk to that of the next smaller one
}  // namespace

EmissionDisks::EmissionDisks(const BoundingSphere& scene, const BoundingSphere& seen) : scene_(scene), seen_(seen) {
  // The last one has to be smaller by more than it takes to choose among one more.
  if (seen.radius > 0.0f)
    while (disk(inner_).radius * 2.0f < scene.radius) ++inner_;
}

BoundingSphere EmissionDisks::disk(int level) const {
  return {seen_.center, seen_.radius * std::pow(kRatio, static_cast<float>(level))};
}

EmissionDisks::Entry EmissionDisks::sample(Vec2 u, Vec3 d) const {
  const float choice = u.x * static_cast<float>(inner_ + 1);
  const int level = std::min(static_cast<int>(choice), inner_);
  const BoundingSphere chosen = level < inner_ ? disk(level) : scene_;
  const Vec2 at = sample_disk_concentric({std::min(choice - static_cast<float>(level), kOneMinusEpsilon), u.y});
  Entry e;
  e.start = chosen.center + Frame::from_z(d).to_world({at.x, at.y, -1.0f}) * chosen.radius;
  e.pdf = pdf(e.start, d, level);
  e.starts_within = level < inner_;
  return e;
}

float EmissionDisks::pdf(Point3 p, Vec3 d, int known) const {
  const auto meets = [&](const BoundingSphere& s) {
    return length(cross(to_double(p - s.center), to_double(d))) < static_cast<double>(s.radius);
  };
  double sum = 0;
  for (int level = 0; level <= inner_; ++level) {
    const BoundingSphere s = level < inner_ ? disk(level) : scene_;
    if (level == known || meets(s)) sum += static_cast<double>(pdf_disk()) / sqr(static_cast<double>(s.radius));
  }
  return static_cast<float>(sum / (inner_ + 1));
}

}  // namespace etd
