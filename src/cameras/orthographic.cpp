#include "cameras/orthographic.h"

#include "cameras/screen.h"

namespace etd {

const ModelDecl& OrthographicCamera::decl() {
  static const ModelDecl d =
      with_params({Family::kCamera, "orthographic", "Parallel rays: what is far away looks no smaller.", {}},
                  {Screen::params(), Lens::params(), Shutter::params()});
  return d;
}

OrthographicCamera OrthographicCamera::create(const ParamReader& p, const CameraFrame& frame, CameraData& data) {
  const Screen screen = Screen::create(p, frame);
  const Transform& t = frame.camera_to_world;
  OrthographicCamera c;
  c.corner = to_float(t.point({screen.left, screen.top, 0}));
  c.dx = to_float(t.vector({(screen.right - screen.left) / frame.width, 0, 0}));
  c.dy = to_float(t.vector({0, (screen.bottom - screen.top) / frame.height, 0}));
  c.forward = to_float(t.vector({0, 0, 1}));
  c.lens = Lens::create(p, frame, data);
  return c;
}

}  // namespace etd
