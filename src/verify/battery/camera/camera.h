// The battery over cameras: the rays that a camera makes against what its kind promises, and its importance against its
// rays.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cameras/camera.h"
#include "verify/battery/battery.h"

namespace etd {

// How a camera spreads its film: solid angle per pixel in proportion to cos^3 of the angle to its axis; equal area
// across parallel rays; equal solid angles; solid angles in proportion to the sine of the angle to up;
// none of these.
enum class FilmSpread { kFlat, kParallel, kEqualArea, kLatLong, kOther };

// A parallelogram, from its corner.
struct Window {
  Point3d corner;
  Vec3d a, b;
};

// A camera with its type erased, whose film has kFilmWidth x kFilmHeight pixels.
struct CameraModel {
  static constexpr int kFilmWidth = 24, kFilmHeight = 16;

  std::string name;
  FilmSpread spread = FilmSpread::kFlat;
  Point3 eye;     // about where its rays start
  Vec3 axis, up;  // where it looks and its vertical, in the middle of its shutter's time
  // The part of the plane of the lens in which all rays start, at a ray's time; empty if a ray by chance is none of the
  // camera's (pinholes, parallel rays).
  std::function<Window(float time)> lens;
  // Nothing comes back from we(), because rays have lost their film point.
  bool blurs_alike = false;

  std::function<Ray(const CameraSample&)> generate_ray;
  std::function<float(float)> ray_time;
  std::function<std::optional<CameraImportance>(const Ray&, float margin)> we;
  std::function<std::optional<CameraConnection>(Point3, Vec2 u_lens, float time, float margin)> sample_wi;
};

// Judged. The checks:
// - rays are finite, of unit length, and the same for the same sample; those of a film point meet; the film is spread
//   as the kind of camera promises;
// - those of check_importance().
std::vector<CheckResult> check_camera(const CameraModel& model, const BatteryOptions& options);

// Not judged. The checks:
// - we() of a ray gives the film point back (up to 2e-6 rad and 1e-5 m), and its densities are those of the film's
//   finite differences, where the film makes them; sample_wi() agrees with we() of the ray back;
// - rays from beside the lens, from in front of it, backwards and from beyond the film give nothing, and neither does a
//   point behind the camera;
// - radiance on a sphere around the camera, measured in cells of the film by generate_ray(), agrees with what
//   sample_wi() brings from points spread over the sphere, and with W_e of rays between points of the sphere and of the
//   lens's plane.
std::vector<CheckResult> check_importance(const CameraModel& model, const BatteryOptions& options);

}  // namespace etd
