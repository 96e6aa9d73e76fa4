#include "cameras/orthographic.h"

#include "cameras/screen.h"

namespace etd {

const ModelDecl& OrthographicCamera::decl() {
  static const ModelDecl d =
      with_params({Family::kCamera, "orthographic", "Parallel rays: what is far away looks no smaller.", {}},
                  {Screen::params(), Lens::params(), Shutter::params()});
  return d;
}

OrthographicCamera OrthographicCamera::create(const ParamReader& p, const CameraFrame& frame, CameraData& data) {
  const Screen screen = Screen::create(p, frame);
  const Transform& t = frame.camera_to_world;
  OrthographicCamera c;
  c.corner = to_float(t.point({screen.left, screen.top, 0}));
  c.dx = to_float(t.vector({(screen.right - screen.left) / frame.width, 0, 0}));
  c.dy = to_float(t.vector({0, (screen.bottom - screen.top) / frame.height, 0}));
  c.forward = to_float(t.vector({0, 0, 1}));
  c.lens = Lens::create(p, frame, data);
  return c;
}

// Returns the importance of the ray along unit d that belongs to a point of the film. A point of the lens is a
// direction: those of depth 1 lie in a plane that is |forward . n| away, where the lens is as large as itself times its
// curvature.
CameraImportance OrthographicCamera::through(Vec3d from_corner, float lens_density, Vec3 d) const {
  const PlaneBasis pixel(dx, dy);
  const double area = pixel.area(), height = std::abs(dot(to_double(forward), pixel.normal)) / area;
  const double cosine = std::abs(dot(to_double(d), pixel.normal)) / area;
  CameraImportance i;
  i.film = pixel.coordinates(from_corner);
  i.pdf_position = static_cast<float>(1.0 / area);
  i.cosine = static_cast<float>(cosine);
  const double shrink = static_cast<double>(lens.curvature) / height, cosine3 = cosine * cosine * cosine;
  i.pdf_direction = blurs_alike() ? 1.0f : static_cast<float>(lens_density / (shrink * shrink * cosine3));
  return i;
}

std::optional<CameraImportance> OrthographicCamera::we(Point3 o, Vec3 d) const {
  const PlaneBasis pixel(dx, dy);
  const Vec3d middle = to_double(forward), from_corner = to_double(o) - to_double(corner);
  const double rounding = kOriginRounding * (length(to_double(corner) - Point3d()) + length(from_corner));
  if (std::abs(dot(from_corner, pixel.normal)) > rounding * pixel.area()) return {};
  const double depth = dot(to_double(d), pixel.normal) / dot(middle, pixel.normal);
  if (!(depth > 0.0)) return {};
  const Vec3d turned = middle - to_double(d) * (1.0 / depth);
  if (lens.is_pinhole()) {
    if (length(turned) > kOriginRounding * length(middle)) return {};
    return through(from_corner, 1.0f, d);
  }
  if (blurs_alike()) return {};
  const double focus = 1.0 / static_cast<double>(lens.curvature);
  const float density = lens.density(turned * focus, kOriginRounding * focus * length(middle));
  if (!(density > 0.0f)) return {};
  return through(from_corner - turned * focus, density, d);
}

std::optional<CameraConnection> OrthographicCamera::sample_wi(Point3 p, Vec2 u_lens) const {
  const PlaneBasis pixel(dx, dy);
  const Vec3 offset = lens.sample(u_lens), along = forward - offset * lens.curvature;
  const Vec3d from_corner = to_double(p) - to_double(corner);
  const double depth = dot(from_corner, pixel.normal) / dot(to_double(forward), pixel.normal);
  const float density = lens.density(to_double(offset), kOriginRounding * length(to_double(offset)));
  if (!(depth > 0.0 && density > 0.0f)) return {};
  const Vec3 d = normalize(along);
  const CameraImportance i = through(from_corner - to_double(along) * depth - to_double(offset), density, d);
  const bool is_delta = blurs_alike();
  return CameraConnection{.wi = -d,
                          .distance = static_cast<float>(depth) * length(along),
                          .importance = i,
                          .pdf = is_delta ? 1.0f : i.pdf_direction,
                          .weight = i.pdf_position / i.cosine,
                          .is_delta = is_delta};
}

void OrthographicCamera::move(const Transform& t) {
  corner = to_float(t.point(to_double(corner)));
  for (Vec3* v : {&dx, &dy, &forward}) *v = to_float(t.vector(to_double(*v)));
  lens.move(t);
}

}  // namespace etd
