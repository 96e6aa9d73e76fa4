// The pinhole camera: looks along +z of its space, y up, x right.
#pragma once

#include "cameras/camera.h"

namespace etd {

struct PerspectiveCamera {
  Point3 origin;
  Vec3 corner;  // direction through the film's top left corner, at depth 1 in camera space
  Vec3 dx, dy;  // its change per pixel

  static const ModelDecl& decl();
  static PerspectiveCamera create(const ParamReader& p, const CameraFrame& frame);

  Ray generate_ray(const CameraSample& s) const {
    return {origin, normalize(corner + dx * s.film.x + dy * s.film.y), kInfinity, s.time};
  }
};

}  // namespace etd
