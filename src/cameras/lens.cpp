#include "cameras/lens.h"

namespace etd {

std::vector<ParamDecl> Lens::params() {
  std::vector<ParamDecl> params = {
      {.name = "lensradius",
       .default_value = 0.0,
       .min = 0,
       .unit = "m",
       .doc = "Radius of the lens; 0 is a pinhole, in whose picture everything is in focus."},
      {.name = "focaldistance",
       .default_value = 1e6,
       .min = 0,
       .above_min = true,
       .unit = "m",
       .doc = "Distance from the lens, along the direction of view, of the plane that is in focus."}};
  for (ParamDecl& p : Aperture::params()) params.push_back(std::move(p));
  return params;
}

Lens Lens::create(const ParamReader& p, const CameraFrame& frame, CameraData& data) {
  Lens lens;
  lens.aperture = Aperture::create(p, frame.images, data);
  const double radius = p.number("lensradius");
  lens.x = to_float(frame.camera_to_world.vector({radius, 0, 0}));
  lens.y = to_float(frame.camera_to_world.vector({0, radius, 0}));
  lens.curvature = static_cast<float>(1.0 / p.number("focaldistance"));
  for (const char* name : {"aperture", "blades"})
    if (const Param* given = p.given(name); given && radius == 0)
      p.diagnostics().warning(given->loc, "a pinhole has no shape: without \"lensradius\" this changes nothing");
  return lens;
}

float Lens::density(Vec3d offset, double rounding) const {
  if (is_pinhole()) return length(offset) <= rounding ? 1.0f : 0.0f;
  const PlaneBasis plane(x, y);
  const double area = plane.area();
  if (std::abs(dot(offset, plane.normal)) > rounding * area) return 0.0f;
  // All openings but some images are seen whole from their middle: drawing points towards it widens their rim.
  const double shrink = 1.0 / (1.0 + rounding / std::min(length(plane.a), length(plane.b)));
  return aperture.density(plane.coordinates(offset * shrink)) / static_cast<float>(area);
}

void Lens::move(const Transform& t) {
  x = to_float(t.vector(to_double(x)));
  y = to_float(t.vector(to_double(y)));
}

}  // namespace etd
