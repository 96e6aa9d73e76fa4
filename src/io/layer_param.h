// The parameter of textures and lights that says which part or layer of an image file they mean.
#pragma once

#include "params/declaration.h"

namespace etd {

inline ParamDecl layer_param() {
  return {.name = "layer",
          .type = ParamType::kString,
          .doc = "The part or layer of an EXR file to take; otherwise the only one with R, G and B. Not in pbrt-v4."};
}

inline std::string layer_name(const ParamReader& params) {
  const Param* layer = params.given("layer");
  return layer ? layer->strings[0] : std::string();
}

constexpr const char* kLayerHint = "\"string layer\" of an imagemap or light names the one to take";

}  // namespace etd
