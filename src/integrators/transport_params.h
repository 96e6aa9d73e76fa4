// The parameters that every integrator of light transport has.
#pragma once

#include <string>
#include <vector>

#include "light_sampling/light_sampler.h"
#include "params/declaration.h"
#include "scene/scene.h"

namespace etd {

struct TransportSettings {
  int max_depth = 5;                                     // scattering events of the longest path
  bool emission = true, direct = true, indirect = true;  // which components are kept
  int roulette_depth = 2;                                // first depth at which paths may be ended early
  std::string light_sampler;                             // empty: the scene's
};

// Their declarations. Roulette starts at `roulette_depth` unless a scene says otherwise; no path may have more
// scattering events than `deepest`.
std::vector<ParamDecl> transport_params(int roulette_depth, int deepest = 1 << 20);
TransportSettings transport_settings(const ParamReader& p);
// The scene's light sampler, or the one that is asked for.
LightSampler light_sampler_of(const Scene& scene, const TransportSettings& settings);

// Which paths an integrator that starts at lights renders: all, or those alone that paths from the camera find too.
ParamDecl paths_from_lights_param();
bool leaves_out_what_the_camera_misses(const ParamReader& p);

}  // namespace etd
