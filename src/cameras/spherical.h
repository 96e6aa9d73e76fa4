// The camera that sees all directions from one point.
#pragma once

#include "cameras/camera.h"

namespace etd {

struct SphericalCamera {
  Point3 origin;
  Vec3 x, y, z;  // the axes of camera space, in the world
  Vec2 pixel;    // the size of a pixel as a share of the image
  bool equal_area = true;

  static const ModelDecl& decl();
  static SphericalCamera create(const ParamReader& p, const CameraFrame& frame, CameraData& data);

  Ray generate_ray(const CameraSample& s) const {
    const Vec3 d = direction({s.film.x * pixel.x, s.film.y * pixel.y});
    return {origin, normalize(x * d.x + y * d.y + z * d.z)};
  }
  // Returns the direction, in camera space, of a point of the image that is given in shares of its sides.
  Vec3 direction(Vec2 st) const;
  std::optional<CameraImportance> we(Point3 o, Vec3 d) const;
  std::optional<CameraConnection> sample_wi(Point3 p, Vec2 u_lens) const;
  void move(const Transform& t);
  Vec2 repeated(Vec2 film, int column, int row) const;

 private:
  std::optional<CameraImportance> along(Vec3 d) const;
  Vec2 film(Vec3 d) const;
};

}  // namespace etd
