// Radiance from infinitely far away that comes in through a window alone. Everywhere else the light is black, also for
// rays that look at it directly: the window must be the only place where the rest of the scene is open.
#pragma once

#include "lights/infinite.h"
#include "lights/light_data.h"

namespace etd {

struct PortalInfiniteLight {
  const PortalMap* map;
  float scale = 1;

  // Of an infinite light with a "portal".
  static std::optional<PortalInfiniteLight> create(const ParamReader& p, const LightContext& context);

  bool is_infinite() const { return true; }
  bool is_delta() const { return false; }
  // Complete whatever is asked for: the window has taken away already what scattering finds well.
  std::optional<LightSample> sample_li(Point3 p, Vec2 u, LightSampling) const {
    const std::optional<Vec3> w = map->sample(p, u);
    if (!w) return {};
    LightSample s;
    s.wi = *w;
    s.radiance = map->value(p, s.wi) * scale;
    s.pdf = map->pdf(p, s.wi);
    if (!(s.pdf > 0.0f) || !std::isfinite(s.pdf) || is_black(s.radiance)) return {};
    return s;
  }
  float pdf_li(Point3 p, Vec3 wi, const SurfacePoint*, LightSampling) const { return map->pdf(p, wi); }
  Spectrum emitted(const SurfacePoint*, Vec3 w, Point3 seen_from) const { return map->value(seen_from, -w) * scale; }
  // What comes in through the portal.
  Spectrum power() const { return map->flux() * scale; }
};

}  // namespace etd
