#include "cameras/perspective.h"

#include "cameras/screen.h"

namespace etd {

const ModelDecl& PerspectiveCamera::decl() {
  static const ModelDecl d =
      with_params({Family::kCamera,
                   "perspective",
                   "A picture in which straight lines stay straight, through a pinhole or a lens.",
                   {{.name = "fov",
                     .default_value = 90.0,
                     .min = 0,
                     .max = 179.999,
                     .above_min = true,
                     .unit = "degrees",
                     .doc = "Full angle of view along the shorter side of the image."}}},
                  {Screen::params(), Lens::params(), Shutter::params()});
  return d;
}

PerspectiveCamera PerspectiveCamera::create(const ParamReader& p, const CameraFrame& frame, CameraData& data) {
  const Screen screen = Screen::create(p, frame);
  const double scale = std::tan(radians(p.number("fov")) / 2.0);
  const Transform& t = frame.camera_to_world;
  PerspectiveCamera c;
  c.origin = to_float(t.point({0, 0, 0}));
  c.corner = to_float(t.vector({screen.left * scale, screen.top * scale, 1.0}));
  c.dx = to_float(t.vector({(screen.right - screen.left) * scale / frame.width, 0, 0}));
  c.dy = to_float(t.vector({0, (screen.bottom - screen.top) * scale / frame.height, 0}));
  c.lens = Lens::create(p, frame, data);
  return c;
}

// Returns the importance of the ray along unit d through a point of the lens. The film at depth 1 is |volume| /
// |normal| away and a pixel there has the area |normal|, so that it fills the solid angle |normal| cos / |d / depth|^2.
std::optional<CameraImportance> PerspectiveCamera::through(Vec3d offset, float pdf_position, Vec3 d) const {
  const PlaneBasis pixel(dx, dy);
  const double volume = dot(to_double(corner), pixel.normal), depth = dot(to_double(d), pixel.normal) / volume;
  if (!(pdf_position > 0.0f && depth > 0.0)) return {};
  CameraImportance i;
  const Vec3d on_film = to_double(d) * (1.0 / depth) + offset * static_cast<double>(lens.curvature);
  i.film = pixel.coordinates(on_film - to_double(corner));
  i.pdf_position = pdf_position;
  i.pdf_direction = static_cast<float>(1.0 / (depth * depth * depth * std::abs(volume)));
  i.cosine = static_cast<float>(depth * std::abs(volume) / pixel.area());
  return i;
}

std::optional<CameraImportance> PerspectiveCamera::we(Point3 o, Vec3 d) const {
  const Vec3d middle = to_double(origin) - Point3d(), offset = to_double(o) - to_double(origin);
  return through(offset, lens.density(offset, kOriginRounding * (length(middle) + length(offset))), d);
}

std::optional<CameraConnection> PerspectiveCamera::sample_wi(Point3 p, Vec2 u_lens) const {
  const Vec3 offset = lens.sample(u_lens), way = p - (origin + offset);
  const float distance = length(way);
  if (!(distance > 0.0f)) return {};
  const Vec3 d = way / distance;
  const Vec3d from_middle = to_double(offset);
  const auto i = through(from_middle, lens.density(from_middle, kOriginRounding * length(from_middle)), d);
  if (!i) return {};
  const bool pinhole = lens.is_pinhole();
  return CameraConnection{.wi = -d,
                          .distance = distance,
                          .importance = *i,
                          .pdf = pinhole ? 1.0f : i->pdf_position * sqr(distance) / i->cosine,
                          .weight = i->pdf_direction / sqr(distance),
                          .is_delta = pinhole};
}

void PerspectiveCamera::move(const Transform& t) {
  origin = to_float(t.point(to_double(origin)));
  for (Vec3* v : {&corner, &dx, &dy}) *v = to_float(t.vector(to_double(*v)));
  lens.move(t);
}

}  // namespace etd
