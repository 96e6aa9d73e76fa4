// Answers ray queries over a Geometry. A concrete class, not an interface: nothing virtual runs per ray. The
// implementation behind it is chosen by the folder that is built (accel/embree/).
#pragma once

#include <memory>

#include "accel/geometry.h"
#include "accel/ray.h"
#include "core/loading.h"

namespace etd {

class Accelerator {
 public:
  // Builds over `geometry`, which must outlive it unchanged (its buffers are shared). Throws std::runtime_error with a
  // readable message when memory runs out, and LoadingStopped when `monitor` says so, which is told of the building.
  explicit Accelerator(const Geometry& geometry, const LoadMonitor& monitor = {});
  ~Accelerator();
  Accelerator(Accelerator&&) noexcept;
  Accelerator& operator=(Accelerator&&) noexcept;

  // The nearest hit with ray.t_min < t < ray.t_max; false (and hit untouched) when there is none.
  bool intersect(const Ray& ray, Hit& hit) const;
  // Whether anything lies strictly between ray.t_min and ray.t_max.
  bool occluded(const Ray& ray) const;
  // Returns the map under which rays meet an instance at a time, as Embree interpolates it; the identity for one
  // without shapes.
  Affine instance_to_world(uint32_t instance, float time) const;
  // Memory of the acceleration structure alone.
  size_t bytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace etd
