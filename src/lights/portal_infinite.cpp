#include "lights/portal_infinite.h"

#include <fmt/format.h>

#include "textures/resolve.h"

namespace etd {

namespace {

// Four corners around a rectangle, in the scene file's world whatever the transform is: the format has it so. The light
// comes from the side of (p3 - p0) x (p1 - p0).
std::optional<Portal> read_portal(const ParamReader& p, const LightContext& context) {
  const Param& given = *p.given("portal");
  const std::vector<double> numbers = p.numbers("portal");
  const auto error = [&](const std::string& what) {
    p.diagnostics().error(given.value_loc, what, "valid: the four corners of a rectangle, one after the other");
    return std::nullopt;
  };
  if (numbers.size() != 12) return error(fmt::format("a portal has 4 corners, not {}", numbers.size() / 3));
  Point3d corners[4];
  for (size_t i = 0; i < 4; ++i)
    corners[i] = context.from_world.point({numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]});
  const Vec3d x = corners[3] - corners[0], y = corners[1] - corners[0], gap = corners[2] - corners[0] - x - y;
  const double lx = length(x), ly = length(y);
  constexpr double kTolerance = 1e-3;  // coordinates in files are rounded
  if (!(lx > 0.0 && ly > 0.0)) return error("this portal has no area");
  if (std::abs(dot(x, y)) > kTolerance * lx * ly || length(gap) > kTolerance * std::min(lx, ly))
    return error("this portal is no rectangle");
  const Vec3d ex = x * (1.0 / lx), ey = normalize(y - ex * dot(ex, y));
  return Portal{to_float(corners[0]), Frame{to_float(ex), to_float(ey), to_float(cross(ex, ey))},
                static_cast<float>(lx), static_cast<float>(ly)};
}

}  // namespace

std::optional<PortalInfiniteLight> PortalInfiniteLight::create(const ParamReader& p, const LightContext& context) {
  reject_radiance_beside_file(p);
  const std::optional<Portal> portal = read_portal(p, context);
  const std::optional<Frame> axes = light_axes(context.to_world, p);
  const EnvironmentMap* map = nullptr;
  if (p.given("filename")) {
    map = read_environment(p, context);
  } else {
    const Spectrum radiance = emission_value(p, "L");
    map = &context.data.environments.emplace_back(
        Image(1, 1, 3, std::vector<float>{radiance[0], radiance[1], radiance[2]}));
  }
  if (!portal || !axes || !map) return {};
  const float scale = emission_scale(p, "illuminance", p.number("illuminance") > 0 ? map->irradiance_up() : Spectrum());
  return PortalInfiniteLight{&context.data.portals.emplace_back(*map, *axes, *portal), scale};
}

}  // namespace etd
