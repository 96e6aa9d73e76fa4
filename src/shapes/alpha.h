// The parameter that every shape takes to have holes.
#pragma once

#include "params/declaration.h"

namespace etd {

inline ParamDecl alpha_param() {
  return {.name = "alpha",
          .type = ParamType::kFloatTexture,
          .default_value = 1.0,
          .min = 0,
          .max = 1,
          .clamp = true,
          .doc = "Share of the surface that is there: rays pass through the rest of it."};
}

}  // namespace etd
