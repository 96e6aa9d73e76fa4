// The parameter that says which part or layer of an image file a texture, light, material or camera means.
#pragma once

#include "params/declaration.h"

namespace etd {

// `file`: the parameter that names the file, where others do too.
inline ParamDecl layer_param(const std::string& file = {}) {
  return {.name = "layer",
          .type = ParamType::kString,
          .doc = "The part or layer of an EXR file" + (file.empty() ? "" : " named by " + file) +
                 " to take; otherwise the only one with R, G and B. Not in pbrt-v4."};
}

inline std::string layer_name(const ParamReader& params) {
  const Param* layer = params.given("layer");
  return layer ? layer->strings[0] : std::string();
}

// A warning where there is no file whose layer it could be.
inline void reject_layer_without_file(const ParamReader& params, const char* file) {
  if (const Param* layer = params.given("layer"))
    params.diagnostics().warning(layer->loc,
                                 std::string("\"layer\" changes nothing without a file as \"") + file + "\"");
}

constexpr const char* kLayerHint = "\"string layer\" beside the file's name says which one to take";

}  // namespace etd
