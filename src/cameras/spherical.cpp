#include "cameras/spherical.h"

#include "core/equal_area.h"

namespace etd {

const ModelDecl& SphericalCamera::decl() {
  static const ModelDecl d = with_params(
      {Family::kCamera,
       "spherical",
       "All directions from one point.",
       {{.name = "mapping",
         .type = ParamType::kString,
         .default_value = std::string("equalarea"),
         .choices = {"equalarea", "equirectangular"},
         .doc =
             "Where directions lie in the image: equalarea is the octahedral map of infinite lights with the camera's "
             "up (y) in the middle, all pixels seeing equal solid angles; equirectangular has the angle to up along "
             "its height and that around it, from x towards z, along its width."}}},
      {Shutter::params()});
  return d;
}

SphericalCamera SphericalCamera::create(const ParamReader& p, const CameraFrame& frame, CameraData&) {
  const Transform& t = frame.camera_to_world;
  SphericalCamera c;
  c.origin = to_float(t.point({0, 0, 0}));
  c.x = to_float(t.vector({1, 0, 0}));
  c.y = to_float(t.vector({0, 1, 0}));
  c.z = to_float(t.vector({0, 0, 1}));
  c.pixel = {1.0f / static_cast<float>(frame.width), 1.0f / static_cast<float>(frame.height)};
  c.equal_area = p.string("mapping") == "equalarea";
  return c;
}

Vec3 SphericalCamera::direction(Vec2 st) const {
  if (equal_area) {
    const Vec3 d = equal_area_direction(wrap_equal_area_square(st));
    return {d.x, d.z, d.y};
  }
  // Beyond the poles, where filters reach, the formula goes on with the other half of the great circle.
  const float theta = kPi * st.y, phi = 2.0f * kPi * st.x;
  return {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
}

// Returns the film position of a unit direction of camera space, the one in [0, width) x [0, height).
Vec2 SphericalCamera::film(Vec3 d) const {
  Vec2 st;
  if (equal_area) {
    st = equal_area_square({d.x, d.z, d.y});
  } else {
    const float turns = std::atan2(d.z, d.x) / (2.0f * kPi);
    st = {turns < 0.0f ? turns + 1.0f : turns, std::atan2(std::hypot(d.x, d.z), d.y) / kPi};
  }
  const auto pixels = [](float share, float size) {
    return std::min(share / size, next_down(std::round(1.0f / size)));
  };
  return {pixels(st.x, pixel.x), pixels(st.y, pixel.y)};
}

Vec2 SphericalCamera::repeated(Vec2 film, int column, int row) const {
  Vec2 st{film.x * pixel.x, film.y * pixel.y};
  const bool odd_column = column % 2 != 0, odd_row = row % 2 != 0;
  if (equal_area) {  // each edge that is crossed turns the square by half a turn
    if (odd_column != odd_row) st = {1.0f - st.x, 1.0f - st.y};
  } else if (odd_row) {  // beyond a pole the meridian on the other side goes on
    st = {st.x < 0.5f ? st.x + 0.5f : st.x - 0.5f, 1.0f - st.y};
  }
  return {(st.x + static_cast<float>(column)) / pixel.x, (st.y + static_cast<float>(row)) / pixel.y};
}

// Returns the importance of a unit direction of the world, in which the axes need be neither at right angles nor of
// length 1.
std::optional<CameraImportance> SphericalCamera::along(Vec3 d) const {
  const Vec3d a = to_double(x), b = to_double(y), c = to_double(z), w = to_double(d);
  const double volume = dot(a, cross(b, c));
  const Vec3d in_camera = Vec3d{dot(w, cross(b, c)), dot(w, cross(c, a)), dot(w, cross(a, b))} * (1.0 / volume);
  const Vec3 local = to_float(normalize(in_camera));
  // Solid angle per pixel: in camera space, and what the axes make of it.
  const float sphere = equal_area ? 4.0f * kPi : 2.0f * kPi * kPi * std::hypot(local.x, local.z);
  const double stretch = std::abs(volume) * std::pow(length(in_camera), 3);
  CameraImportance i;
  i.film = film(local);
  i.pdf_position = 1.0f;
  i.pdf_direction = static_cast<float>(1.0 / (static_cast<double>(sphere * pixel.x * pixel.y) * stretch));
  if (!std::isfinite(i.pdf_direction)) return {};  // at a pole
  return i;
}

std::optional<CameraImportance> SphericalCamera::we(Point3 o, Vec3 d) const {
  const Vec3d middle = to_double(origin) - Point3d(), offset = to_double(o) - to_double(origin);
  if (length(offset) > kOriginRounding * (length(middle) + length(offset))) return {};
  return along(d);
}

std::optional<CameraConnection> SphericalCamera::sample_wi(Point3 p, Vec2) const {
  const Vec3 way = p - origin;
  const float distance = length(way);
  if (!(distance > 0.0f)) return {};
  const auto i = along(way / distance);
  if (!i) return {};
  return CameraConnection{.wi = way / -distance,
                          .distance = distance,
                          .importance = *i,
                          .pdf = 1.0f,
                          .weight = i->pdf_direction / sqr(distance),
                          .is_delta = true};
}

void SphericalCamera::move(const Transform& t) {
  origin = to_float(t.point(to_double(origin)));
  for (Vec3* v : {&x, &y, &z}) *v = to_float(t.vector(to_double(*v)));
}

}  // namespace etd
