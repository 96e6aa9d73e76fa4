// How much of a surface a pixel covers, for any place in the scene and any camera: what textures are filtered over.
#pragma once

#include "cameras/camera.h"

namespace etd {

// An approximation from the camera alone, whatever path led to the place: the smallest change of the camera's rays from
// pixel to pixel, over the whole film, carried on a straight line to the place and onto its tangent plane. It errs
// towards sharp textures (the camera approximation of Pharr, Jakob and Humphreys 2023, section 10.1.2).
class PixelFootprint {
 public:
  struct Step {
    Vec3 dx, dy;  // along both axes of the film
  };

  PixelFootprint() = default;  // a point everywhere
  // `scale`: of the distance between samples rather than pixels.
  PixelFootprint(const Camera& camera, int width, int height, float scale);
  // min(1, max(1/8, 1/sqrt(spp))): the spacing of `spp` samples in a pixel, not to let textures alias between passes.
  static float scale_for(uint32_t spp);

  // Returns the step at the point p (recentred world) of a surface of unit normal n. It is finite, and longest where
  // the surface is seen edge on.
  Step at(Point3 p, Vec3 n) const;

 private:
  struct Change {
    float origin = 0, direction = 0;  // of a ray, from one pixel to the next
  };
  Point3 origin_;       // of the rays, in the middle of the film
  Vec3 axis_{0, 0, 1};  // unit direction there
  Vec3 right_;          // along the film's x
  bool parallel_ = false;
  Change x_, y_;
};

}  // namespace etd
