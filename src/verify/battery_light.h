// The battery over lights: what a light says of itself (density, power) and what its samples bring is compared with
// rays that search for it in all directions.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "accel/geometry.h"
#include "lights/examples.h"
#include "verify/check.h"

namespace etd {

// A light with its type erased, and the surface on which rays can find it (none when infinite).
struct LightModel {
  std::string name;
  Geometry geometry;
  Spectrum power;
  bool infinite = false, delta = false;
  bool through_portal = false;  // see LightExample
  LightSampling sampling = LightSampling::kComplete;
  std::function<std::optional<LightSample>(Point3, Vec2)> sample_li;
  std::function<float(Point3, Vec3, const SurfacePoint*)> pdf_li;
  std::function<Spectrum(const SurfacePoint*, Vec3, Point3)> emitted;
};
LightModel light_model(const LightExample& example);

struct LightBatteryOptions {
  size_t samples = 100000;     // per point and method
  uint64_t seed = 1;           // of the random numbers; every seed must pass
  double family_level = 1e-5;  // probability of any false alarm among the checks of one model
};

// Judged. The checks:
// - samples: finite, unit wi towards the point on the light, radiance = emitted(), pdf = pdf_li() there and at the
// point
//   that a ray along wi meets;
// - the visible samples follow pdf_li() (chi-square with a cell for all others), whose integral is their share;
// - radiance integrated over directions with three weights agrees between light samples and rays in all directions;
// - power() agrees with the flux along random lines (infinite: through a disk of area pi).
// Compensated samples need not bring all the radiance. Of delta lights: pdf is 1 and pdf_li() and emitted() are 0, and
// power() agrees with the flux of the samples through a sphere.
std::vector<CheckResult> check_light(const LightModel& model, const LightBatteryOptions& options);

}  // namespace etd
