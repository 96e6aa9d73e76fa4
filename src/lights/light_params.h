// Parameters that several lights share, and what they mean.
#pragma once

#include <optional>

#include "core/frame.h"
#include "core/transform.h"
#include "io/layer_param.h"
#include "params/declaration.h"
#include "spectrum/spectrum.h"

namespace etd {

inline ParamDecl scale_param() {
  return {.name = "scale", .default_value = 1.0, .min = 0, .doc = "Factor on all that is emitted."};
}
inline ParamDecl power_param() {
  return {.name = "power",
          .default_value = -1.0,
          .unit = "W",
          .doc =
              "If positive, the luminance of all emitted power before \"scale\"; the other parameters then give "
              "colour and distribution alone."};
}
inline ParamDecl illuminance_param(std::string surface) {
  return {.name = "illuminance",
          .default_value = -1.0,
          .unit = "W/m^2",
          .doc = "If positive, the luminance of the irradiance on a surface " + surface +
                 " before \"scale\"; the other parameters then give colour and distribution alone."};
}
inline ParamDecl filename_param(std::string what, bool required) {
  return {.name = "filename", .type = ParamType::kString, .required = required, .doc = std::move(what)};
}

// The factor on emission that "scale" and a photometric target ("power", "illuminance") ask for; `emitted` is what the
// light's other parameters give of the targeted quantity. A black light that should have power is an error.
float emission_scale(const ParamReader& params, std::string_view target, const Spectrum& emitted);

// An error when both an "L" and a "filename" say what the light's radiance is.
void reject_radiance_beside_file(const ParamReader& params);

// The direction from "from" to "to", in the light's own space, not normalised; an error when they coincide.
std::optional<Vec3d> light_direction(const ParamReader& params);

// The axes of a light's own space in the world, unit vectors. Transforms that distort angles are an error: they would
// change how much light goes where.
std::optional<Frame> light_axes(const Transform& to_world, const ParamReader& params);

}  // namespace etd
