// Says where the lights that are no surfaces end up: those of the world, and those of objects once for each instance.
#pragma once

#include <vector>

#include "core/animated_transform.h"
#include "params/diagnostics.h"
#include "scene/description.h"

namespace etd {

// One light of the description and all the places where it shines: paths from the world that it was described in, which
// for a light of an object is the object's space, to the world. Empty for a light of an object without an instance.
struct PlacedLight {
  const LightDesc* light;
  std::vector<TransformPath> places;
};

// Reports instances that together would place more lights than memory holds, and places none of objects then.
std::vector<PlacedLight> place_lights(const SceneDescription& description, Diagnostics& diagnostics);

}  // namespace etd
