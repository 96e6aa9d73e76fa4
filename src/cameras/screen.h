// The window that cameras with a flat picture look through.
#pragma once

#include "cameras/camera.h"

namespace etd {

// The sides are in camera space: at depth 1 for a perspective camera before its field of view, in units of length for
// an orthographic one. Left may be greater than right, and bottom than top: the picture is then mirrored.
struct Screen {
  double left = -1, right = 1, bottom = -1, top = 1;

  static std::vector<ParamDecl> params();
  // Makes the screen as given, otherwise of the frame's proportions and from -1 to 1 along its shorter side.
  static Screen create(const ParamReader& p, const CameraFrame& frame);
};

}  // namespace etd
