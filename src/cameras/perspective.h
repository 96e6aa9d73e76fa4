// The camera whose rays go through one point, or a lens there: looks along +z of its space, y up, x right.
#pragma once

#include "cameras/lens.h"

namespace etd {

struct PerspectiveCamera {
  Point3 origin;
  Vec3 corner;  // direction through the film's top left corner, at depth 1 in camera space
  Vec3 dx, dy;  // its change per pixel
  Lens lens;

  static const ModelDecl& decl();
  static PerspectiveCamera create(const ParamReader& p, const CameraFrame& frame, CameraData& data);

  Ray generate_ray(const CameraSample& s) const { return lens.ray(origin, corner + dx * s.film.x + dy * s.film.y, s); }
};

}  // namespace etd
