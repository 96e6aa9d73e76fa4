// The cameras that the battery tests: every kind in the settings of its parameters, and what those do not reach.
#pragma once

#include "params/param.h"
#include "verify/battery/camera/camera.h"

namespace etd {

struct CameraSetting {
  std::string name;
  ModelUse use;
  bool moves = false;      // turns and shifts while the shutter is open
  bool stretched = false;  // its space is stretched, and skewed across the axis
};
std::vector<CameraSetting> camera_settings();

// The camera as compile() makes it, in a place of its own; on failure `problem` says why.
struct MadeCamera {
  CameraModel model;
  std::string problem;
};
MadeCamera camera_model(const CameraSetting& setting);

}  // namespace etd
