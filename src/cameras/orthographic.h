// The camera whose rays are parallel: they start on a window at z = 0 of its space and go along +z, y up, x right.
#pragma once

#include "cameras/lens.h"

namespace etd {

struct OrthographicCamera {
  Point3 corner;  // of the film, top left
  Vec3 dx, dy;    // from pixel to pixel
  Vec3 forward;   // of depth 1 in camera space
  Lens lens;      // one around each point of the film, so that the blur is the same all over the picture

  static const ModelDecl& decl();
  static OrthographicCamera create(const ParamReader& p, const CameraFrame& frame, CameraData& data);

  Ray generate_ray(const CameraSample& s) const {
    return lens.ray(corner + (dx * s.film.x + dy * s.film.y), forward, s);
  }
  // Whether a lens turns rays so little (less than 1e-3 at its rim) that rounding hides from which of its points they
  // come: their directions are then taken for one.
  bool blurs_alike() const { return length(lens.x) * lens.curvature < 1e-3f * length(forward); }
  std::optional<CameraImportance> we(Point3 o, Vec3 d) const;
  std::optional<CameraConnection> sample_wi(Point3 p, Vec2 u_lens) const;
  void move(const Transform& t);

 private:
  CameraImportance through(Vec3d from_corner, float lens_density, Vec3 d) const;
};

}  // namespace etd
