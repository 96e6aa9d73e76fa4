// The family of area lights: models that a scene puts on shapes. Each surface of the shape becomes a light.
#pragma once

#include <map>

#include "io/named_images.h"
#include "lights/light.h"
#include "lights/light_surfaces.h"

namespace etd {

// The surfaces of one shape. They are counted kind by kind in this order.
struct ShapeSurfaces {
  std::vector<RectangleSurface> rectangles = {};
  std::vector<TriangleSurface> triangles = {};
  std::vector<PatchSurface> patches = {};
  std::vector<QuadricSurface> quadrics = {};

  size_t size() const { return rectangles.size() + triangles.size() + patches.size() + quadrics.size(); }
  // f(rectangles, triangles, patches, quadrics)
  template <class F>
  auto with_all(F&& f) const {
    return f(rectangles, triangles, patches, quadrics);
  }
};

// What an area light is made in, beside its parameters.
struct AreaLightContext {
  const ShapeSurfaces& surfaces;  // what they refer to outlives the lights
  ImageSource images;
  LightData& data;         // keeps what the lights refer to
  bool invisible = false;  // no ray meets the surfaces
};

struct AreaLights {
  std::vector<Light> lights;  // one for each surface
  Spectrum power;             // of all together
};

std::span<const ModelDecl* const> area_light_models();
// Makes the lights of a checked use, which stays where it is; those of "diffuse" for an unknown name.
AreaLights make_area_lights(const ModelUse& use, const AreaLightContext& context, Diagnostics& diagnostics);

}  // namespace etd
