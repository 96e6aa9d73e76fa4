// Lights described in a space that moves: at a ray's time they are that space's lights, seen from there.
#include "lights/light.h"
#include "shapes/placement.h"

namespace etd {

namespace {

// Solid angle in the light's space per solid angle in the world around the unit vector w: |det M^-1| / |M^-1 w|^3.
float solid_angle_stretch(const Placement& at, Vec3 w) {
  const Affine& m = at.to_object;
  const Vec3 v = m.vector(w);
  return std::abs(dot(m.x, cross(m.y, m.z))) / (dot(v, v) * length(v));
}

}  // namespace

Light Light::moving(const AnimatedTransform& motion) const {
  Light light = *this;
  light.motion_ = &motion;
  light.power_scale_ = is_infinite() ? 1.0f : static_cast<float>(motion.mean_area_scale());
  return light;
}

std::optional<LightSample> Light::sample_moving(Point3 p, Vec2 u, const ShadingContext& context,
                                                LightSampling sampling) const {
  const Placement at = placement_at(*motion_, context.time);
  auto s = sample_still(at.to_object.point(p), u, context, sampling);
  if (!s) return {};
  if (is_infinite()) {
    s->wi = normalize(at.to_world.vector(s->wi));
    if (s->is_delta) return s;
    // Looked up again for the direction as it was rounded, as rays that meet it otherwise do.
    s->radiance = emitted(nullptr, -s->wi, context, p);
    s->pdf = pdf_moving(p, s->wi, nullptr, context, sampling);
  } else {
    s->on_light = to_world(s->on_light, at);
    const Vec3 d = s->on_light.p - p;
    const float d2 = dot(d, d);
    if (!(d2 > 0.0f)) return {};
    s->wi = d * (1.0f / std::sqrt(d2));
    s->pdf *= solid_angle_stretch(at, s->wi);
    if (s->is_delta) return s;
    s->radiance = emitted(&s->on_light, -s->wi, context, p);
  }
  if (is_black(s->radiance) || !(s->pdf > 0.0f) || !std::isfinite(s->pdf)) return {};
  return s;
}

float Light::pdf_moving(Point3 p, Vec3 wi, const SurfacePoint* on_light, const ShadingContext& context,
                        LightSampling sampling) const {
  const Placement at = placement_at(*motion_, context.time);
  const Vec3 w = normalize(at.to_object.vector(wi));
  const SurfacePoint seen = on_light ? to_object(*on_light, at) : SurfacePoint{};
  const float pdf = pdf_still(at.to_object.point(p), w, on_light ? &seen : nullptr, context, sampling);
  return pdf * solid_angle_stretch(at, wi);
}

// A normal turns like the space if that keeps its shape; between two keys it is within half of the step's angle of
// where it is at one of them, or at the first or last time.
LightBounds Light::bounds_moving(const LightBounds& still, float start, float end) const {
  LightBounds b = still;
  b.intensity *= power_scale_;
  b.box = motion_->swept(still.box, start, end);
  if (!motion_->is_rigid()) {
    b.cone = {still.cone.axis, kPi, still.cone.both};
    return b;
  }
  const auto [first, last] = motion_->keys_between(start, end);
  const auto steps = static_cast<float>(motion_->keys().size() - 1);
  std::optional<DirectionCone> cone;
  double step = 0;
  for (size_t k = first; k <= last; ++k) {
    DirectionCone then = still.cone;
    then.axis = normalize(
        to_float(motion_->at(clamp(static_cast<float>(k) / steps, start, end)).vector(to_double(still.cone.axis))));
    cone = cone ? unite(*cone, then) : then;
    if (k < last) step = std::max(step, motion_->turn(k));
  }
  b.cone = *cone;
  b.cone.spread = std::min(b.cone.spread + 0.5f * static_cast<float>(step) + 1e-4f, kPi);
  return b;
}

}  // namespace etd
