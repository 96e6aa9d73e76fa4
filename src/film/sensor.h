// What turns radiance into the numbers of an image, sample by sample: exposure, white balance, and a limit for those
// who ask for one. All but the limit is linear, so means, squares and errors are those of the exposed radiance.
#pragma once

#include <array>
#include <cmath>
#include <string>

#include "film/pixel_sample.h"
#include "params/declaration.h"

namespace etd {

struct Sensor {
  double imaging_ratio = 1;  // exposure time in seconds times ISO / 100
  double white_balance = 0;  // kelvin; 0: none
  double max_component = HUGE_VAL;

  static std::vector<ParamDecl> params();
  // `shutter` is how long the camera's shutter is open, in seconds: the exposure time unless the film has its own.
  static Sensor create(const ParamReader& p, double shutter);

  // Exposes emission, direct and indirect of one sample.
  void expose(PixelSample& sample) const;
  // What makes the image differ from the unbiased one; empty when nothing does.
  std::string bias() const;

 private:
  bool changes_colours_ = false;
  std::array<Vec3, 3> rows_{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};  // imaging ratio and white balance
};

}  // namespace etd
