// A thin lens in front of a camera with a flat picture: what is not at the focal distance is blurred.
#pragma once

#include "cameras/aperture.h"

namespace etd {

struct Lens {
  Vec3 x, y;            // from the middle of the lens to its edge, to the right and up, in the world
  float curvature = 0;  // 1 / focal distance
  Aperture aperture;

  static std::vector<ParamDecl> params();
  static Lens create(const ParamReader& p, const CameraFrame& frame, CameraData& data);

  // The ray through a point of the lens that meets the pinhole's ray (from `origin`, where the lens has its middle,
  // along `d`, which has depth 1 in camera space) at the focal distance: they belong to the same point in focus.
  Ray ray(Point3 origin, Vec3 d, const CameraSample& s) const {
    if (x == Vec3()) return {origin, normalize(d)};
    const Vec2 p = aperture.sample(s.lens);
    const Vec3 offset = x * p.x + y * p.y;
    return {origin + offset, normalize(d - offset * curvature)};
  }
};

}  // namespace etd
