// A thin lens in front of a camera with a flat picture: what is not at the focal distance is blurred.
#pragma once

#include "cameras/aperture.h"
#include "cameras/plane.h"

namespace etd {

struct Lens {
  Vec3 x, y;            // from the middle of the lens to its edge, to the right and up, in the world
  float curvature = 0;  // 1 / focal distance
  Aperture aperture;

  static std::vector<ParamDecl> params();
  static Lens create(const ParamReader& p, const CameraFrame& frame, CameraData& data);

  bool is_pinhole() const { return x == Vec3(); }
  // Returns the way from its middle to a point of it, in proportion to the aperture; 0 for a pinhole.
  Vec3 sample(Vec2 u) const {
    if (is_pinhole()) return {};
    const Vec2 p = aperture.sample(u);
    return x * p.x + y * p.y;
  }
  // The density of sample() per area (m^-2), 0 beside the opening; 1 in a pinhole. Offsets up to `rounding` (m) away
  // from a point of the lens count as that point.
  float density(Vec3d offset, double rounding) const;
  void move(const Transform& t);

  // The ray through a point of the lens that meets the pinhole's ray (from `origin`, where the lens has its middle,
  // along `d`, which has depth 1 in camera space) at the focal distance: they belong to the same point in focus.
  Ray ray(Point3 origin, Vec3 d, const CameraSample& s) const {
    if (is_pinhole()) return {origin, normalize(d)};
    const Vec3 offset = sample(s.lens);
    return {origin + offset, normalize(d - offset * curvature)};
  }
};

}  // namespace etd
