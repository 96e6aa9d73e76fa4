// Intensity within a cone around an axis, with a soft edge.
#pragma once

#include <fmt/format.h>

#include "lights/point_lights.h"
#include "textures/resolve.h"

namespace etd {

struct SpotIntensity {
  Spectrum value;
  Vec3 axis;
  float cos_inner = 1, cos_outer = 0;  // full within the inner cone, none outside of the outer one

  static const ModelDecl& decl() {
    static const ModelDecl d{Family::kLight,
                             "spot",
                             "Light within a cone, from one point.",
                             {intensity_param(),
                              position_param(),
                              {.name = "to",
                               .type = ParamType::kPoint3,
                               .default_value = std::vector<double>{0, 0, 1},
                               .unit = "m",
                               .doc = "A point on the axis of the cone."},
                              {.name = "coneangle",
                               .default_value = 30.0,
                               .min = 0,
                               .max = 180,
                               .above_min = true,
                               .unit = "degrees",
                               .doc = "Between the axis and the edge of the cone."},
                              {.name = "conedeltaangle",
                               .default_value = 5.0,
                               .min = 0,
                               .max = 180,
                               .unit = "degrees",
                               .doc = "Within the edge of the cone, over which the light fades."},
                              scale_param(),
                              power_param()}};
    return d;
  }
  static std::optional<PointLight<SpotIntensity>> create(const ParamReader& p, const LightContext& context) {
    SpotIntensity s;
    const std::optional<Frame> axes = light_axes(context.to_world, p);
    const std::optional<Vec3d> along = light_direction(p);
    const double outer = p.number("coneangle"), fade = p.number("conedeltaangle");
    if (fade > outer)
      p.diagnostics().error(p.use().loc,
                            fmt::format("the cone of {:g} degrees can't fade over {:g} degrees", outer, fade));
    if (!axes || !along || fade > outer) return {};
    s.axis = to_float(normalize(context.to_world.vector(*along)));
    s.cos_outer = static_cast<float>(std::cos(radians(outer)));
    s.cos_inner = static_cast<float>(std::cos(radians(outer - fade)));
    s.value = emission_value(p, "I");
    s.value *= emission_scale(p, "power", s.power());
    return PointLight<SpotIntensity>{light_position(p, context), s};
  }

  // A cubic smooth step in the cosine between the cones.
  Spectrum intensity(Vec3 w, const ShadingContext&) const {
    const float c = dot(w, axis);
    if (c >= cos_inner) return value;
    if (c <= cos_outer) return Spectrum();
    const float t = (c - cos_outer) / (cos_inner - cos_outer);
    return value * (t * t * (3.0f - 2.0f * t));
  }
  // Uniform within the cone.
  std::optional<Vec3> sample(Vec2 u) const {
    const float z = 1.0f - u.x * (1.0f - cos_outer), r = safe_sqrt((1.0f - z) * (1.0f + z)), phi = 2.0f * kPi * u.y;
    return normalize(Frame::from_z(axis).to_world({r * std::cos(phi), r * std::sin(phi), z}));
  }
  float pdf(Vec3 w) const { return dot(w, axis) > cos_outer ? 0.5f * kInvPi / (1.0f - cos_outer) : 0.0f; }
  // The step's mean is 1/2.
  Spectrum power() const { return value * (2.0f * kPi * (1.0f - 0.5f * (cos_inner + cos_outer))); }
  void bound(LightBounds& b) const {
    const float inner = std::acos(clamp(cos_inner, -1.0f, 1.0f));
    b.cone = {axis, inner, false};
    b.fall = std::acos(clamp(cos_outer, -1.0f, 1.0f)) - inner;
    b.intensity = luminance(value);
  }
};

}  // namespace etd
