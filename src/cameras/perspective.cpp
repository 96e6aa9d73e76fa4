#include "cameras/perspective.h"

#include "cameras/screen.h"

namespace etd {

const ModelDecl& PerspectiveCamera::decl() {
  static const ModelDecl d =
      with_params({Family::kCamera,
                   "perspective",
                   "A picture in which straight lines stay straight, through a pinhole or a lens.",
                   {{.name = "fov",
                     .default_value = 90.0,
                     .min = 0,
                     .max = 179.999,
                     .above_min = true,
                     .unit = "degrees",
                     .doc = "Full angle of view along the shorter side of the image."}}},
                  {Screen::params(), Lens::params(), Shutter::params()});
  return d;
}

PerspectiveCamera PerspectiveCamera::create(const ParamReader& p, const CameraFrame& frame, CameraData& data) {
  const Screen screen = Screen::create(p, frame);
  const double scale = std::tan(radians(p.number("fov")) / 2.0);
  const Transform& t = frame.camera_to_world;
  PerspectiveCamera c;
  c.origin = to_float(t.point({0, 0, 0}));
  c.corner = to_float(t.vector({screen.left * scale, screen.top * scale, 1.0}));
  c.dx = to_float(t.vector({(screen.right - screen.left) * scale / frame.width, 0, 0}));
  c.dy = to_float(t.vector({0, (screen.bottom - screen.top) * scale / frame.height, 0}));
  c.lens = Lens::create(p, frame, data);
  return c;
}

}  // namespace etd
