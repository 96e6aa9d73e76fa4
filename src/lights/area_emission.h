// What a surface emits: the same radiance from every point, or an image over its uv; to one side or both.
#pragma once

#include "io/image.h"
#include "shapes/surface_point.h"
#include "spectrum/spectrum.h"

namespace etd {

struct AreaEmission {
  Spectrum radiance{1.0f};       // times that of the image, if there is one
  const Image* image = nullptr;  // (0, 0) is its lower left corner; beyond its edges they go on
  bool two_sided = false;
  bool invisible = false;  // no ray meets the surface, so that only sampling the light finds it

  // Radiance that leaves s along w.
  Spectrum towards(const SurfacePoint& s, Vec3 w) const {
    if (!two_sided && !(dot(s.ng, w) > 0.0f)) return Spectrum();
    return image ? radiance * image_value(s.uv) : radiance;
  }
  Spectrum at(Vec2 uv) const { return image ? radiance * image_value(uv) : radiance; }

 private:
  Spectrum image_value(Vec2 uv) const;  // bilinear between the centres of texels
};

}  // namespace etd
