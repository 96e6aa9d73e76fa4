#include "lights/light.h"

#include "core/warp.h"
#include "lights/light_list.h"
#include "params/model_list.h"
#include "shapes/placement.h"

namespace etd {

namespace {
// Infinite lights without rays of their own are the same wherever they are seen from: what they send to one point they
// send along all parallel rays.
template <class T>
constexpr bool kSameFromEverywhere = !requires {
  &T::sample_le;
};

// The ray that brings the sample's light through a point of a disk that faces it.
EmissionSample through_disk(const LightSample& s, Vec2 u, const EmissionDisks& disks) {
  const EmissionDisks::Entry entry = disks.sample(u, -s.wi);
  EmissionSample e;
  e.ray = {entry.start, -s.wi};
  e.radiance = s.radiance;
  e.pdf_position = entry.pdf;
  e.pdf_direction = s.pdf;
  e.starts_within = entry.starts_within;
  return e;
}

std::optional<Placement> placement(const AnimatedTransform* motion, float time) {
  return motion ? std::optional(placement_at(*motion, time)) : std::nullopt;
}
}  // namespace

bool Light::is_infinite() const {
  return dispatch<bool, Lights>(storage_, [](const auto& l) { return l.is_infinite(); });
}

bool Light::is_delta() const {
  return dispatch<bool, Lights>(storage_, [](const auto& l) { return l.is_delta(); });
}

std::optional<LightSample> Light::sample_li(Point3 p, Vec2 u, const ShadingContext& context,
                                            LightSampling sampling) const {
  return motion_ ? sample_moving(p, u, context, sampling) : sample_still(p, u, context, sampling);
}

float Light::pdf_li(Point3 p, Vec3 wi, const SurfacePoint* on_light, const ShadingContext& context,
                    LightSampling sampling) const {
  return motion_ ? pdf_moving(p, wi, on_light, context, sampling) : pdf_still(p, wi, on_light, context, sampling);
}

std::optional<LightSample> Light::sample_still(Point3 p, Vec2 u, const ShadingContext& context,
                                               LightSampling sampling) const {
  return dispatch<std::optional<LightSample>, Lights>(
      storage_, [&](const auto& l) { return l.sample_li(p, u, context, sampling); });
}

float Light::pdf_still(Point3 p, Vec3 wi, const SurfacePoint* on_light, const ShadingContext& context,
                       LightSampling sampling) const {
  return dispatch<float, Lights>(storage_, [&](const auto& l) { return l.pdf_li(p, wi, on_light, context, sampling); });
}

Spectrum Light::emitted(const SurfacePoint* on_light, Vec3 w, const ShadingContext& context, Point3 seen_from) const {
  // What a surface emits depends on nothing that changes when both it and w move.
  if (motion_ && !on_light) w = normalize(placement_at(*motion_, context.time).to_object.vector(w));
  return dispatch<Spectrum, Lights>(storage_,
                                    [&](const auto& l) { return l.emitted(on_light, w, context, seen_from); });
}

std::optional<EmissionSample> Light::sample_le(Vec2 u_position, Vec2 u_direction, const EmissionDisks& disks,
                                               const ShadingContext& context) const {
  using Result = std::optional<EmissionSample>;
  Result sample = dispatch<Result, Lights>(storage_, [&]([[maybe_unused]] const auto& l) -> Result {
    if constexpr (kSameFromEverywhere<std::decay_t<decltype(l)>>) {
      const auto s = sample_li({}, u_direction, context);
      return s ? Result(through_disk(*s, u_position, disks)) : std::nullopt;
    } else {
      const auto at = placement(motion_, context.time);
      return l.sample_le(u_position, u_direction, context, at ? &*at : nullptr);
    }
  });
  if (sample) sample->ray.time = context.time;
  return sample;
}

EmissionDensity Light::pdf_le(const SurfacePoint* on_light, Vec3 w, const EmissionDisks& disks,
                              const ShadingContext& context, Point3 seen_from) const {
  return dispatch<EmissionDensity, Lights>(storage_, [&](const auto& l) -> EmissionDensity {
    if constexpr (kSameFromEverywhere<std::decay_t<decltype(l)>>) {
      return {disks.pdf(seen_from, w), l.is_delta() ? 1.0f : pdf_li(seen_from, -w, nullptr, context)};
    } else {
      const auto at = placement(motion_, context.time);
      return l.pdf_le(on_light, w, context, seen_from, at ? &*at : nullptr);
    }
  });
}

Spectrum Light::power() const {
  return dispatch<Spectrum, Lights>(storage_, [](const auto& l) { return l.power(); }) * power_scale_;
}

std::optional<LightBounds> Light::bounds(float start, float end) const {
  const auto still = dispatch<std::optional<LightBounds>, Lights>(storage_, [](const auto& l) { return l.bounds(); });
  return still && motion_ ? bounds_moving(*still, start, end) : still;
}

bool Light::enters_by_disks() const {
  return dispatch<bool, Lights>(storage_, []<class T>(const T&) { return kSameFromEverywhere<T>; });
}

uint32_t Light::kind_count() { return static_cast<uint32_t>(Lights::kCount); }

std::span<const ModelDecl* const> light_models() {
  static const std::vector<const ModelDecl*> all = declarations(StandingLights{});
  return all;
}

std::optional<Light> make_light(const ModelUse& use, const LightContext& context, Diagnostics& diagnostics) {
  std::optional<Light> light;
  with_model(StandingLights{}, use, diagnostics, [&]<class T>(std::type_identity<T>, const ParamReader& p) {
    if (const auto made = T::create(p, context)) light.emplace(*made);
  });
  return light;
}

}  // namespace etd
