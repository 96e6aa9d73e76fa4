// The importance of cameras: what a film measures of the radiance along a ray, for light paths that join a camera
// (Veach 1997, section 8.3; Pharr, Jakob and Humphreys 2023, sections 5.4 and 13.1 for the path integral).
#pragma once

#include "core/vec.h"

namespace etd {

// This is the importance of one ray from the camera. W_e counts the film in pixels: the integral of W_e L cos over the
// points of the lens and the directions whose film positions are in a pixel is the mean radiance of that pixel, which
// is what rays of weight 1, spread evenly over the pixel, bring. So W_e cos is the density of generate_ray()'s rays per
// pixel of film. Neither the pixel filter nor the shutter is part of it: what arrives at a film position is splatted
// with the normalised filter, and times are those of Camera::ray_time().
//
// A density that is a delta is 1, and then W_e lacks its unit: the position of a pinhole, whose W_e is per steradian,
// and the direction of parallel rays, whose W_e is per square metre.
struct CameraImportance {
  Vec2 film;                // in pixels of the full image
  float pdf_position = 0;   // of the ray's origin per area (m^-2)
  float pdf_direction = 0;  // of its direction per solid angle (sr^-1); both together are the density of the ray
  float cosine = 1;         // between the ray and the normal of the lens; 1 where all directions start in one point

  // W_e in m^-2 sr^-1.
  float we() const { return pdf_position * pdf_direction / cosine; }
};

// A ray that starts this share of the size of its coordinates away from the lens starts there, up to rounding.
inline constexpr double kOriginRounding = 1e-6;

// A way from a point in the scene to the camera, before any occlusion.
struct CameraConnection {
  Vec3 wi;                      // unit direction from the point to the camera
  float distance = 0;           // to the lens, in m
  CameraImportance importance;  // of the ray that comes back along wi
  float pdf = 0;                // of wi per solid angle at the point; 1 if is_delta
  // W_e / pdf: the film position gets this times the radiance that leaves the point along wi times its cosine there,
  // over the density of the point per area. A pinhole at distance d, whose pdf would be infinite, has pdf_direction /
  // d^2 here, and parallel rays have W_e: what the two deltas leave.
  float weight = 0;
  bool is_delta = false;  // no ray by chance comes back through the camera along wi
};

}  // namespace etd
