#include "lights/light_params.h"

#include <fmt/format.h>

namespace etd {

float emission_scale(const ParamReader& params, std::string_view target, const Spectrum& emitted) {
  const double scale = params.number("scale"), wanted = params.number(target);
  if (!(wanted > 0.0)) return static_cast<float>(scale);
  const double given = static_cast<double>(luminance(emitted));
  if (!(given > 0.0)) {
    const Param* p = params.given(target);
    params.diagnostics().error(p ? p->value_loc : params.use().loc,
                               fmt::format("a black light can't have a {} of {:g}", target, wanted));
    return 0.0f;
  }
  return static_cast<float>(scale * wanted / given);
}

void reject_radiance_beside_file(const ParamReader& params) {
  if (const Param* radiance = params.given("L"); radiance && params.given("filename"))
    params.diagnostics().error(radiance->loc, "a light can't have both an L and a file", "give one of them");
}

std::optional<Vec3d> light_direction(const ParamReader& params) {
  const std::vector<double> from = params.numbers("from"), to = params.numbers("to");
  const Vec3d along{to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  if (length(along) > 0.0) return along;
  const Param* p = params.given("to") ? params.given("to") : params.given("from");
  params.diagnostics().error(
      p ? p->value_loc : params.use().loc,
      fmt::format("\"from\" and \"to\" of this {} light are the same point", params.decl().name));
  return {};
}

std::optional<Frame> light_axes(const Transform& to_world, const ParamReader& params) {
  const Vec3d axes[3] = {to_world.vector({1, 0, 0}), to_world.vector({0, 1, 0}), to_world.vector({0, 0, 1})};
  constexpr double kTolerance = 1e-3;  // matrices in files are rounded
  const double size2 = dot(axes[0], axes[0]);
  bool even = size2 > 0.0;
  for (int i = 0; i < 3; ++i) {
    even = even && std::abs(dot(axes[i], axes[i]) - size2) <= kTolerance * size2;
    even = even && std::abs(dot(axes[i], axes[(i + 1) % 3])) <= kTolerance * size2;
  }
  if (!even) {
    params.diagnostics().error(params.use().loc,
                               fmt::format("the transform of this {} light distorts angles", params.decl().name),
                               "it may turn, mirror, move and scale evenly");
    return {};
  }
  // Orthonormal to float precision: rounded matrices are a little off.
  const Vec3d x = normalize(axes[0]), y = normalize(axes[1] - x * dot(x, axes[1]));
  const Vec3d z = cross(x, y) * (dot(cross(x, y), axes[2]) < 0.0 ? -1.0 : 1.0);
  return Frame{to_float(x), to_float(y), to_float(z)};
}

}  // namespace etd
