// The lists of lights, for those who make them. To add one: its header, and its name in the list of its kind.
#pragma once

#include "lights/constant_infinite.h"
#include "lights/diffuse_area.h"
#include "lights/distant.h"
#include "lights/goniometric.h"
#include "lights/image_infinite.h"
#include "lights/point.h"
#include "lights/portal_infinite.h"
#include "lights/projection.h"
#include "lights/spot.h"

namespace etd {

// These stand on shapes. A type T of the list has T::decl(), T::create(), and T::On<Surface>, its light on a surface.
using AreaLightModels = TypeList<DiffuseArea>;

// These stand by themselves.
using StandingLights = TypeList<PortalInfiniteLight, ImageInfiniteLight, ConstantInfiniteLight, DistantLight,
                                PointLight<IsotropicIntensity>, PointLight<SpotIntensity>,
                                PointLight<GoniometricIntensity>, PointLight<ProjectionIntensity>>;

template <class T>
using OnEachSurface = TypeList<typename T::template On<TriangleSurface>, typename T::template On<RectangleSurface>,
                               typename T::template On<PatchSurface>, typename T::template On<QuadricSurface>>;

template <class Models>
struct LightsOf;
template <class... Ts>
struct LightsOf<TypeList<Ts...>> {
  using Type = JoinedList<OnEachSurface<Ts>..., StandingLights>;
};
using Lights = LightsOf<AreaLightModels>::Type;

template <class T>
Light::Light(const T& light) {
  storage_.store<Lights>(light);
}

}  // namespace etd
