// Rays that start on surfaces: they leave it without meeting it again, and stop short of the surface they aim at.
#pragma once

#include "accel/ray.h"
#include "shapes/surface_point.h"

namespace etd {

// The ray that leaves `s` along w (any length). Here and below, it goes on at the time and in the medium of `before`.
ETD_FN Ray spawn_ray(const SurfacePoint& s, Vec3 w, const Ray& before = {}) {
  return {offset_origin(s, w), w, kInfinity, before.time, before.medium};
}

// The open segment between two surface points, for occluded(): d is the whole segment, both ends moved off their
// surfaces. The plane at `to` is met at t = 1 + something positive, but both d (rounded: relative error u = 2^-24) and
// the intersector (vertices relative to a far origin: 8u |d|, as in shapes/triangle.cpp) move it by up to 9u |d| along
// the normal, which is 9u / cos in t. t_max stays 16u / cos under 1, at most 2^-10 at grazing angles, where the cosine
// itself extinguishes what could be lost.
ETD_FN Ray shadow_ray(const SurfacePoint& from, const SurfacePoint& to, const Ray& before = {}) {
  const Vec3 along = to.p - from.p;
  const Point3 o = offset_origin(from, along);
  const Vec3 d = offset_origin(to, -along) - o;
  const float across = std::abs(dot(d, to.ng)), slack = 0x1p-20f * length(d);
  const float shortening = slack < 0x1p-10f * across ? slack / across : 0x1p-10f;
  return {o, d, 1.0f - shortening, before.time, before.medium};
}

// The segment from a surface to a point that lies on no surface, for occluded(): d is the whole segment.
ETD_FN Ray shadow_ray(const SurfacePoint& from, Point3 to, const Ray& before = {}) {
  const Point3 o = offset_origin(from, to - from.p);
  return {o, to - o, 1.0f, before.time, before.medium};
}

}  // namespace etd
