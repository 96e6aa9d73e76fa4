// The list of lights, for those who make them. To add one: its header, and its name in the list.
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

using Lights = TypeList<DiffuseAreaLight<TriangleSurface>, DiffuseAreaLight<RectangleSurface>,
                        DiffuseAreaLight<PatchSurface>, DiffuseAreaLight<QuadricSurface>, PortalInfiniteLight,
                        ImageInfiniteLight, ConstantInfiniteLight, DistantLight, PointLight<IsotropicIntensity>,
                        PointLight<SpotIntensity>, PointLight<GoniometricIntensity>, PointLight<ProjectionIntensity>>;

template <class T>
Light::Light(const T& light) {
  storage_.store<Lights>(light);
}

}  // namespace etd
