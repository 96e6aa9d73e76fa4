// The declared parameters of a sum of noise.
#pragma once

#include "params/declaration.h"
#include "textures/noise.h"

namespace etd {

inline std::vector<ParamDecl> noise_params() {
  return {{.name = "octaves",
           .type = ParamType::kInteger,
           .default_value = 8,
           .min = 0,
           .max = 32,
           .doc = "How many octaves of noise are summed, where the footprint of a pixel does not hide some."},
          {.name = "roughness",
           .default_value = 0.5,
           .min = 0,
           .max = 8,
           .doc = "Size of each octave relative to the one of half its frequency."}};
}

inline NoiseSum noise_sum(const ParamReader& p) {
  return {p.integer("octaves"), static_cast<float>(p.number("roughness"))};
}

}  // namespace etd
