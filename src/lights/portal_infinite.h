// Radiance from infinitely far away that comes in through a window alone. Everywhere else the light is black, also for
// rays that look at it directly: the window must be the only place where the rest of the scene is open.
#pragma once

#include "lights/infinite.h"
#include "lights/light_data.h"
#include "shapes/placement.h"

namespace etd {

struct PortalInfiniteLight {
  const PortalMap* map;
  float scale = 1;

  static const ModelDecl& decl() { return infinite_decl(); }
  static bool is_meant(const ParamReader& p) { return p.given("portal") != nullptr; }
  static std::optional<PortalInfiniteLight> create(const ParamReader& p, const LightContext& context);

  bool is_infinite() const { return true; }
  bool is_delta() const { return false; }
  // Complete whatever is asked for: the window has taken away already what scattering finds well.
  std::optional<LightSample> sample_li(Point3 p, Vec2 u, const ShadingContext&, LightSampling) const {
    const std::optional<Vec3> w = map->sample(p, u);
    if (!w) return {};
    LightSample s;
    s.wi = *w;
    s.radiance = map->value(p, s.wi) * scale;
    s.pdf = map->pdf(p, s.wi);
    if (!(s.pdf > 0.0f) || !std::isfinite(s.pdf) || is_black(s.radiance)) return {};
    return s;
  }
  float pdf_li(Point3 p, Vec3 wi, const SurfacePoint*, const ShadingContext&, LightSampling) const {
    return map->pdf(p, wi);
  }
  Spectrum emitted(const SurfacePoint*, Vec3 w, const ShadingContext&, Point3 seen_from) const {
    return map->value(seen_from, -w) * scale;
  }
  // Uniform over the portal, and in directions in proportion to the mean of R, G and B. A portal does not move.
  std::optional<EmissionSample> sample_le(Vec2 u_position, Vec2 u_direction, const ShadingContext&,
                                          const Placement*) const {
    const std::optional<Vec3> from = map->sample(u_direction);
    if (!from) return {};
    const Portal& portal = map->portal();
    const Point3 p =
        portal.corner + portal.frame.to_world({u_position.x * portal.width, u_position.y * portal.height, 0.0f});
    EmissionSample s;
    s.ray = {p, -*from};
    s.starts_within = true;
    s.on_light.p = p;
    s.on_light.ng = s.on_light.ns = -portal.frame.z;
    s.radiance = map->value(*from) * scale;
    s.pdf_position = pdf_position();
    s.pdf_direction = map->pdf(*from);
    s.cosine = dot(*from, portal.frame.z);
    if (is_black(s.radiance) || !(s.cosine > 0.0f && s.pdf_direction > 0.0f) || !std::isfinite(s.pdf_direction))
      return {};
    return s;
  }
  EmissionDensity pdf_le(const SurfacePoint*, Vec3 w, const ShadingContext&, Point3 seen_from, const Placement*) const {
    return {map->is_open(seen_from, -w) ? pdf_position() : 0.0f, map->pdf(-w)};
  }
  // What comes in through the portal.
  Spectrum power() const { return map->flux() * scale; }
  static std::optional<LightBounds> bounds() { return {}; }

 private:
  float pdf_position() const { return 1.0f / (map->portal().width * map->portal().height); }
};

}  // namespace etd
