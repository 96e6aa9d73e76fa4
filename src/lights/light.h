// The family of lights. A light on a surface is one triangle or one quadric; an infinite light surrounds the scene; a
// delta light sends what it sends from a single point or direction, or from a surface that no ray meets, so that only
// sampling the light finds it.
#pragma once

#include <optional>
#include <span>

#include "core/animated_transform.h"
#include "core/ray.h"
#include "core/tagged.h"
#include "core/transform.h"
#include "io/named_images.h"
#include "lights/emission_disks.h"
#include "lights/light_bounds.h"
#include "params/declaration.h"
#include "shapes/surface_point.h"
#include "spectrum/shading_context.h"
#include "spectrum/spectrum.h"

namespace etd {

// Light that arrives at a point, before any occlusion.
struct LightSample {
  Vec3 wi;            // unit direction to the light
  Spectrum radiance;  // that leaves the light towards the point
  float pdf = 0;      // per solid angle at the point; 1 of a point or direction, whose radiance is irradiance across wi
  SurfacePoint on_light;  // where it comes from; unused when infinite
  bool is_delta = false;
};

// A ray along which light leaves its source: where a path from a light starts (Veach 1997, chapter 10; Pharr, Jakob and
// Humphreys 2016, section 16.1.2).
struct EmissionSample {
  Ray ray;                 // unit d; leaves the light's surface; of an infinite light it comes from infinitely far away
  Spectrum radiance;       // along the ray; of a point its intensity, of a single direction the irradiance across it
  float pdf_position = 0;  // per area: of the surface or the portal, otherwise across the ray; 1 of a point
  float pdf_direction = 0;  // per solid angle; 1 of a single direction
  float cosine = 1;         // between the ray and the normal of the area that pdf_position counts
  // Of an infinite light: whether it has passed a part of the scene before the start of `ray`, which is near what is
  // seen.
  bool starts_within = false;
  SurfacePoint on_light;  // where the ray leaves; of a portal, where it comes in; unused of other infinite lights

  // The flux that the sample stands for, W: its mean is the light's power, that of infinite lights through the disk
  // across the ray that hides the whole scene.
  Spectrum weight() const { return radiance * (cosine / (pdf_position * pdf_direction)); }
};

// The densities of an EmissionSample.
struct EmissionDensity {
  float position = 0, direction = 0;
};

// What light sampling can count on. With kComplete its density is positive wherever light may come from; with
// kCompensated another technique covers all directions as well (multiple importance sampling), and so the density may
// leave out what that one finds easily.
enum class LightSampling : uint8_t { kComplete, kCompensated };

class Light {
 public:
  template <class T>
  explicit Light(const T& light);
  // The same light when the space in which it is described moves so; the motion must outlive the light. Only those on
  // surfaces may do more than turn and translate.
  Light moving(const AnimatedTransform& motion) const;

  bool is_infinite() const;
  bool is_delta() const;
  // Nothing when the sample carries no light (wrong side, degenerate geometry): that is an estimate of 0.
  std::optional<LightSample> sample_li(Point3 p, Vec2 u, const ShadingContext& context,
                                       LightSampling sampling = LightSampling::kComplete) const;
  // Solid-angle density with which sample_li makes wi, 0 where it makes none and for delta lights; `on_light` is the
  // point met there, null for infinite lights.
  float pdf_li(Point3 p, Vec3 wi, const SurfacePoint* on_light, const ShadingContext& context,
               LightSampling sampling = LightSampling::kComplete) const;
  // Radiance that leaves on_light along w; of an infinite light, null and -w: the radiance seen in direction w from the
  // point `seen_from`, on which that of a light behind a portal depends. 0 for delta lights.
  Spectrum emitted(const SurfacePoint* on_light, Vec3 w, const ShadingContext& context, Point3 seen_from = {}) const;
  // A ray of the light, which the two pairs of numbers choose; `disks` is used by infinite lights alone. Nothing when
  // nothing is emitted along it: that is an estimate of 0.
  std::optional<EmissionSample> sample_le(Vec2 u_position, Vec2 u_direction, const EmissionDisks& disks,
                                          const ShadingContext& context) const;
  // The densities with which sample_le makes a ray along which the light emits: from on_light along w or, where that is
  // null, one of an infinite light that passes the point `seen_from` of the scene. What is 1 in samples of points and
  // single directions is 1 here.
  EmissionDensity pdf_le(const SurfacePoint* on_light, Vec3 w, const EmissionDisks& disks,
                         const ShadingContext& context, Point3 seen_from = {}) const;
  // Emitted power of finite lights, W (per lane), its mean over time where they grow, or what comes in through a
  // portal. Other infinite lights have none that does not depend on the scene: theirs is the power through a unit disk,
  // over all directions.
  Spectrum power() const;
  // Where it is and where it sends light between two times in [0, 1]; nothing of infinite lights.
  std::optional<LightBounds> bounds(float start, float end) const;
  bool moves() const { return motion_ != nullptr; }
  // Whether sample_le() starts rays at the disks, as for infinite lights without a portal.
  bool enters_by_disks() const;
  // Which light of the list this is, below kind_count(): tells whether every one of them is tested.
  uint32_t kind() const { return storage_.tag; }
  static uint32_t kind_count();

 private:
  // The first two work in the light's own space.
  std::optional<LightSample> sample_still(Point3 p, Vec2 u, const ShadingContext& context,
                                          LightSampling sampling) const;
  float pdf_still(Point3 p, Vec3 wi, const SurfacePoint* on_light, const ShadingContext& context,
                  LightSampling sampling) const;
  std::optional<LightSample> sample_moving(Point3 p, Vec2 u, const ShadingContext& context,
                                           LightSampling sampling) const;
  float pdf_moving(Point3 p, Vec3 wi, const SurfacePoint* on_light, const ShadingContext& context,
                   LightSampling sampling) const;
  LightBounds bounds_moving(const LightBounds& still, float start, float end) const;

  TaggedStorage<96> storage_;
  const AnimatedTransform* motion_ = nullptr;
  float power_scale_ = 1;
};

struct LightData;

// What a light is made in, beside its parameters.
struct LightContext {
  Transform to_world;         // to the recentred world
  ImageSource images;         // that lights name
  LightData& data;            // keeps what the light refers to
  Transform from_world = {};  // of the scene file to the recentred one
};

std::span<const ModelDecl* const> light_models();
// Makes the light of a checked use that is no area light; nothing for an unknown name and when something is wrong,
// which is reported.
std::optional<Light> make_light(const ModelUse& use, const LightContext& context, Diagnostics& diagnostics);

}  // namespace etd
