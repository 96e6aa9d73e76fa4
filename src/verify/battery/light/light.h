// The battery over lights: what a light says of itself (density, power) and what its samples bring is compared with
// rays that search for it in all directions.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "accel/geometry.h"
#include "lights/examples.h"
#include "verify/battery/check.h"

namespace etd {

// Rays of infinite lights start in the battery at this bounding sphere of a scene, around the unit ball.
inline constexpr BoundingSphere kTestScene{{0.1f, -0.2f, 0.3f}, 1.5f};
// They have two smaller disks inside, which are not in the middle.
inline EmissionDisks test_disks() { return EmissionDisks(kTestScene, {{0.5f, 0.1f, 0.2f}, 0.15f}); }

// A light with its type erased at one time, and the surface on which rays can find it (none when infinite).
struct LightModel {
  std::string name;
  Geometry geometry;
  Spectrum power;
  float time = 0;
  bool infinite = false, delta = false, on_surface = false;
  bool through_portal = false;  // see LightExample
  LightSampling sampling = LightSampling::kComplete;
  std::function<std::optional<LightSample>(Point3, Vec2)> sample_li;
  std::function<float(Point3, Vec3, const SurfacePoint*)> pdf_li;
  std::function<Spectrum(const SurfacePoint*, Vec3, Point3)> emitted;
  std::function<std::optional<EmissionSample>(Vec2, Vec2)> sample_le;
  std::function<EmissionDensity(const SurfacePoint*, Vec3, Point3)> pdf_le;
};
LightModel light_model(const LightExample& example, const EmissionDisks& disks = test_disks());

struct LightBatteryOptions {
  size_t samples = 100000;     // per point and method
  uint64_t seed = 1;           // of the random numbers; every seed must pass
  double family_level = 1e-5;  // probability of any false alarm among the checks of one model
};

// Judged. The checks:
// - samples: finite, unit wi towards the point on the light, radiance = emitted(), pdf = pdf_li() there and at the
//   point that a ray along wi meets;
// - the visible samples follow pdf_li() (chi-square with a cell for all others), whose integral is their share;
// - radiance integrated over directions with three weights agrees between light samples and rays in all directions;
// - power() agrees with the flux along random lines (infinite: through a disk of area pi).
// Compensated samples need not bring all the radiance. Of delta lights: pdf is 1 and pdf_li() and emitted() are 0, and
// power() agrees with the flux of the samples through a sphere.
// Those of check_emission() besides.
std::vector<CheckResult> check_light(const LightModel& model, const LightBatteryOptions& options);

// Emission sampling alone, not judged:
// - samples: finite, unit directions, rays that start on the light or before the scene, densities = pdf_le(),
//   radiance = emitted();
// - directions from one position follow pdf_le() (chi-square), whose integral is their share;
// - positions follow pdf_le(): the shares of samples in parts of the surface (or of the area across the rays) against
//   the integral of the density along random lines;
// - the mean weight is the power;
// - flux, and moments of the directions and places of the lines that carry it, agree with light samples all over a
//   sphere.
// None where light samples are compensated: emission is not, and is tested with the complete ones.
std::vector<CheckResult> check_emission(const LightModel& model, const LightBatteryOptions& options);

}  // namespace etd
