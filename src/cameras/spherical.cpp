#include "cameras/spherical.h"

#include "core/equal_area.h"

namespace etd {

const ModelDecl& SphericalCamera::decl() {
  static const ModelDecl d = with_params(
      {Family::kCamera,
       "spherical",
       "All directions from one point.",
       {{.name = "mapping",
         .type = ParamType::kString,
         .default_value = std::string("equalarea"),
         .choices = {"equalarea", "equirectangular"},
         .doc =
             "Where directions lie in the image: equalarea is the octahedral map of infinite lights with the camera's "
             "up (y) in the middle, all pixels seeing equal solid angles; equirectangular has the angle to up along "
             "its height and that around it, from x towards z, along its width."}}},
      {Shutter::params()});
  return d;
}

SphericalCamera SphericalCamera::create(const ParamReader& p, const CameraFrame& frame) {
  const Transform& t = frame.camera_to_world;
  SphericalCamera c;
  c.origin = to_float(t.point({0, 0, 0}));
  c.x = to_float(t.vector({1, 0, 0}));
  c.y = to_float(t.vector({0, 1, 0}));
  c.z = to_float(t.vector({0, 0, 1}));
  c.pixel = {1.0f / static_cast<float>(frame.width), 1.0f / static_cast<float>(frame.height)};
  c.equal_area = p.string("mapping") == "equalarea";
  return c;
}

Vec3 SphericalCamera::direction(Vec2 st) const {
  if (equal_area) {
    const Vec3 d = equal_area_direction(wrap_equal_area_square(st));
    return {d.x, d.z, d.y};
  }
  // Beyond the poles, where filters reach, the formula goes on with the other half of the great circle.
  const float theta = kPi * st.y, phi = 2.0f * kPi * st.x;
  return {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
}

}  // namespace etd
