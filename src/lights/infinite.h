// The declaration that the infinite lights share: a constant one, one with an image, and one behind a portal.
#pragma once

#include "lights/light_params.h"

namespace etd {

inline const ModelDecl& infinite_decl() {
  static const ModelDecl d{
      Family::kLight,
      "infinite",
      "Light from all directions, from infinitely far away.",
      {{.name = "L",
        .type = ParamType::kSpectrum,
        .default_value = 1.0,
        .min = 0,
        .unit = "W/(m^2 sr)",
        .doc = "Radiance of every direction."},
       filename_param("Image of the radiance by direction, instead of L: square (equal-area octahedral, as pbrt-v4 has "
                      "it, +z in the middle), or twice as wide as high (latitude-longitude, +z above, from +x towards "
                      "+y).",
                      false),
       layer_param(),
       {.name = "portal",
        .type = ParamType::kPoint3,
        .array = true,
        .unit = "m",
        .doc =
            "Four corners of a rectangle, in world space whatever the transform: the light comes in through it alone, "
            "from the side of (p3 - p0) x (p1 - p0), and is black elsewhere."},
       scale_param(),
       illuminance_param("facing the light's +z")}};
  return d;
}

}  // namespace etd
