// What rays find of a light that is tested: the side of the comparisons that knows nothing of sampling.
#pragma once

#include "accel/accelerator.h"
#include "accel/spawn.h"
#include "accel/surface.h"
#include "verify/battery/light/light.h"

namespace etd {

class LightRays {
 public:
  // The light's radiance back along a ray, and where.
  struct Seen {
    Spectrum radiance;
    std::optional<SurfacePoint> point;  // nothing for infinite lights and misses
  };

  // The model must outlive it.
  explicit LightRays(const LightModel& model) : model_(model), accelerator_(model.geometry) {}

  Seen look(Point3 o, Vec3 d) const { return look(line(o, d)); }
  // Calls f(surface point) wherever the line that starts outside of the light crosses its surface.
  template <class F>
  void for_crossings(Point3 o, Vec3 d, F&& f) const {
    Ray ray = line(o, d);
    Seen seen = look(ray);
    // More sheets than this no light has: a surface that rays cannot leave shows as too many.
    for (int sheet = 0; seen.point && sheet < 17; ++sheet) {
      f(*seen.point);
      ray = spawn_ray(*seen.point, d, ray);
      seen = look(ray);
    }
  }
  // Density of light samples along wi, of those that are visible and carry light.
  double pdf_visible(Point3 p, Vec3 wi) const {
    const Seen seen = look(p, wi);
    if (is_black(seen.radiance)) return 0.0;
    return static_cast<double>(model_.pdf_li(p, wi, seen.point ? &*seen.point : nullptr));
  }
  // Whether the light's own surface is not in the way of the sample.
  bool visible(Point3 p, const LightSample& s) const {
    return model_.infinite || !accelerator_.occluded({p, s.on_light.p - p, 1.0f - 1e-4f, model_.time});
  }
  // Whether it is not in the way of the ray.
  bool leaves(const Ray& ray) const { return !accelerator_.occluded(ray); }

 private:
  Ray line(Point3 o, Vec3 d) const { return {o, d, kInfinity, model_.time}; }
  Seen look(const Ray& ray) const {
    Seen seen;
    Hit hit;
    if (accelerator_.intersect(ray, hit)) seen.point = surface_point(model_.geometry, hit);
    if (seen.point || model_.infinite)
      seen.radiance = model_.emitted(seen.point ? &*seen.point : nullptr, -ray.d, ray.o);
    return seen;
  }

  const LightModel& model_;
  Accelerator accelerator_;
};

// The radius of the sphere around the origin through which the light's flux is compared: around the light or the
// portal, any for other infinite lights.
inline float test_radius(const LightModel& m) { return m.infinite && !m.through_portal ? 1.0f : 3.0f; }

}  // namespace etd
