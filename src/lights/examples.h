// The lights that are tested: one list, which the battery walks through. A new light adds its lines here and is tested
// from then on.
#pragma once

#include <memory>
#include <string>

#include "lights/light_data.h"
#include "shapes/mesh.h"
#include "shapes/patch.h"
#include "shapes/quadric.h"

namespace etd {

struct LightExample {
  std::string name;  // light, surface and parameters; unique
  Light light;
  // The surface it is on, as it refers to: one triangle, one quadric, one patch, or none. Near the origin, at most 3
  // away.
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const Quadric> quadric;
  // The images it refers to.
  std::shared_ptr<const LightData> data = {};
  LightSampling sampling = LightSampling::kComplete;
  std::shared_ptr<const PatchMesh> patches = {};
  bool through_portal = false;  // an infinite light behind a portal that is at most 3 away: its power is what comes in
  // How the light and its surface move, at which time they are tested, and the light's power at that time where it is
  // not the mean that power() tells.
  std::shared_ptr<const AnimatedTransform> motion = {};
  float time = 0;
  std::optional<Spectrum> power_then = {};
};

// The same list at every call, in a fixed order.
std::span<const LightExample> light_examples();

}  // namespace etd
