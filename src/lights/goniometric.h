// Intensity from one point that an image of directions varies, as measured lamps have it.
#pragma once

#include "lights/light_data.h"
#include "lights/point_lights.h"
#include "textures/resolve.h"

namespace etd {

struct GoniometricIntensity {
  Spectrum value;  // where the map is 1
  const EnvironmentMap* map = nullptr;
  Frame axes;  // of the map, in the world

  static const ModelDecl& decl() {
    static const ModelDecl d{Family::kLight,
                             "goniometric",
                             "Light from one point, varied by direction with an image.",
                             {intensity_param(),
                              filename_param("Image of factors on I by direction, the mean of its colours: square "
                                             "(equal-area octahedral) or twice as wide as high (latitude-longitude); "
                                             "the light's +y is in the middle or above.",
                                             true),
                              layer_param(), scale_param(), power_param()}};
    return d;
  }
  static std::optional<PointLight<GoniometricIntensity>> create(const ParamReader& p, const LightContext& context) {
    const std::optional<Frame> light = light_axes(context.to_world, p);
    const EnvironmentMap* map = read_environment(p, context);
    if (!light || !map) return {};
    GoniometricIntensity g;
    g.map = map;
    g.axes = {light->x, light->z, light->y};
    g.value = emission_value(p, "I");
    g.value *= emission_scale(p, "power", g.power());
    return PointLight<GoniometricIntensity>{light_position(p, context), g};
  }

  Spectrum intensity(Vec3 w, const ShadingContext&) const { return value * mean_value(map->value(axes.to_local(w))); }
  std::optional<Vec3> sample(Vec2 u) const {
    const std::optional<Vec3> w = map->sample(u, LightSampling::kComplete);
    return w ? std::optional(normalize(axes.to_world(*w))) : std::nullopt;
  }
  float pdf(Vec3 w) const { return map->pdf(axes.to_local(w), LightSampling::kComplete); }
  Spectrum power() const { return value * mean_value(map->integral()); }
  // The mean over all directions has to do, because any of them may be the bright one.
  void bound(LightBounds& b) const { b.intensity = luminance(power()) / (4.0f * kPi); }
};

}  // namespace etd
