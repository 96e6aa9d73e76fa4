// The parameters that every integrator of light transport has.
#pragma once

#include <vector>

#include "light_sampling/light_sampler.h"
#include "params/declaration.h"

namespace etd {

struct TransportSettings {
  int max_depth = 5;                                     // scattering events of the longest path
  bool emission = true, direct = true, indirect = true;  // which components are kept
  int roulette_depth = 2;                                // first depth at which paths may be ended early
  LightChoice light_choice = LightChoice::kPower;
};

// Their declarations. No path may have more scattering events than `deepest`.
std::vector<ParamDecl> transport_params(int deepest = 1 << 20);
TransportSettings transport_settings(const ParamReader& p);

// Which paths an integrator that starts at lights renders: all, or those alone that paths from the camera find too.
ParamDecl paths_from_lights_param();
bool leaves_out_what_the_camera_misses(const ParamReader& p);

}  // namespace etd
