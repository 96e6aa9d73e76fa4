#include "cameras/perspective.h"

namespace etd {

const ModelDecl& PerspectiveCamera::decl() {
  static const ModelDecl d{
      Family::kCamera,
      "perspective",
      "A pinhole: everything in focus, straight lines stay straight.",
      {{.name = "fov",
        .default_value = 90.0,
        .min = 0,
        .max = 179.999,
        .above_min = true,
        .unit = "degrees",
        .doc = "Full angle of view along the shorter side of the image."},
       {.name = "frameaspectratio",
        .min = 0,
        .above_min = true,
        .doc = "Width over height of the frame; by default that of the image."},
       {.name = "screenwindow",
        .array = true,
        .doc = "Left, right, bottom and top of the film, in units in which its shorter side goes from -1 to 1."}}};
  return d;
}

PerspectiveCamera PerspectiveCamera::create(const ParamReader& p, const CameraFrame& frame) {
  const Param* aspect_given = p.given("frameaspectratio");
  const double aspect = aspect_given ? aspect_given->numbers[0] : double(frame.width) / double(frame.height);
  double left = -1, right = 1, bottom = -1, top = 1;
  if (aspect > 1)
    left = -aspect, right = aspect;
  else
    bottom = -1 / aspect, top = 1 / aspect;
  if (const Param* window = p.given("screenwindow")) {
    const std::vector<double>& w = window->numbers;
    if (w.size() != 4 || w[0] == w[1] || w[2] == w[3])
      p.diagnostics().error(window->value_loc, "\"screenwindow\" takes four numbers: left, right, bottom, top",
                            "left and right must differ, and so must bottom and top");
    else
      left = w[0], right = w[1], bottom = w[2], top = w[3];
  }
  const double scale = std::tan(radians(p.number("fov")) / 2.0);
  const Transform& t = frame.camera_to_world;
  PerspectiveCamera c;
  c.origin = to_float(t.point({0, 0, 0}));
  c.corner = to_float(t.vector({left * scale, top * scale, 1.0}));
  c.dx = to_float(t.vector({(right - left) * scale / frame.width, 0, 0}));
  c.dy = to_float(t.vector({0, (bottom - top) * scale / frame.height, 0}));
  return c;
}

}  // namespace etd
