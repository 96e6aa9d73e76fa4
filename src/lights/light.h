// The family of lights. A light on a surface is one triangle or one sphere; an infinite light surrounds the scene.
#pragma once

#include <optional>
#include <span>

#include "core/tagged.h"
#include "params/declaration.h"
#include "shapes/surface_point.h"
#include "spectrum/spectrum.h"

namespace etd {

// Light that arrives at a point, before any occlusion.
struct LightSample {
  Vec3 wi;                // unit direction to the light
  Spectrum radiance;      // that leaves the light towards the point
  float pdf = 0;          // per solid angle at the point
  SurfacePoint on_light;  // where it comes from; unused when infinite
};

class Light {
 public:
  template <class T>
  explicit Light(const T& light);

  bool is_infinite() const;
  // Nothing when the sample carries no light (wrong side, degenerate geometry): that is an estimate of 0.
  std::optional<LightSample> sample_li(Point3 p, Vec2 u) const;
  // Solid-angle density with which sample_li makes wi; `on_light` is the point met there, null for infinite lights.
  float pdf_li(Point3 p, Vec3 wi, const SurfacePoint* on_light) const;
  // Radiance that leaves on_light along w; of an infinite light, null and -w: the radiance seen in direction w.
  Spectrum emitted(const SurfacePoint* on_light, Vec3 w) const;
  // Emitted power of finite lights, W (per lane). Infinite lights have none that does not depend on the scene: theirs
  // is the power through a unit disk, over all directions.
  Spectrum power() const;
  // Which light of the list this is, below kind_count(): tells whether every one of them is tested.
  uint32_t kind() const { return storage_.tag; }
  static uint32_t kind_count();

 private:
  TaggedStorage<64> storage_;
};

std::span<const ModelDecl* const> light_models();
std::span<const ModelDecl* const> area_light_models();

}  // namespace etd
