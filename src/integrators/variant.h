// One way of an algorithm to estimate the image of a scene. All ways must agree, which verification tests; each
// algorithm names its own.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace etd {

using ParameterTexts = std::vector<std::pair<std::string, std::string>>;  // name and value, as after --set integrator.

struct Variant {
  std::string name;
  ParameterTexts set = {};
  std::string sampler = "sobol";
  std::string integrator = {};        // filled in by integrator_variants()
  bool samples_lights_alone = false;  // single samples may be as bright as SamplePeaks::light
  std::string not_applicable = {};    // why it estimates another image in this scene, if it does
  // These parameters halve the radius of a consistent estimator whose bias goes with its square. Both are rendered, and
  // the bias is taken off by extrapolation to a radius of 0.
  ParameterTexts with_half_radius = {};
  // Parameters with which path estimates the same image, if others than its defaults.
  ParameterTexts image_of_path = {};
};

}  // namespace etd
