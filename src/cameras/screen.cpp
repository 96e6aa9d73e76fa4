#include "cameras/screen.h"

namespace etd {

std::vector<ParamDecl> Screen::params() {
  return {{.name = "frameaspectratio",
           .min = 0,
           .above_min = true,
           .doc = "Width over height of the frame; by default that of the image."},
          {.name = "screenwindow",
           .array = true,
           .doc = "Left, right, bottom and top of the film, in units in which its shorter side goes from -1 to 1; "
                  "those of an orthographic camera are units of length."}};
}

Screen Screen::create(const ParamReader& p, const CameraFrame& frame) {
  if (const Param* window = p.given("screenwindow")) {
    const std::vector<double>& w = window->numbers;
    if (w.size() == 4 && w[0] != w[1] && w[2] != w[3]) return {w[0], w[1], w[2], w[3]};
    p.diagnostics().error(window->value_loc, "\"screenwindow\" takes four numbers: left, right, bottom, top",
                          "left and right must differ, and so must bottom and top");
  }
  const Param* given = p.given("frameaspectratio");
  const double aspect = given ? given->numbers[0] : double(frame.width) / double(frame.height);
  if (aspect > 1) return {-aspect, aspect, -1, 1};
  return {-1, 1, -1 / aspect, 1 / aspect};
}

}  // namespace etd
