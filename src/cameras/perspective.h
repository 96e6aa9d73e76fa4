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
  std::optional<CameraImportance> we(Point3 o, Vec3 d) const;
  std::optional<CameraConnection> sample_wi(Point3 p, Vec2 u_lens) const;
  void move(const Transform& t);

 private:
  std::optional<CameraImportance> through(Vec3d offset, float pdf_position, Vec3 d) const;
};

}  // namespace etd
