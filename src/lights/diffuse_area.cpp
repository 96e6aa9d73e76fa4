#include "lights/diffuse_area.h"

#include <algorithm>
#include <tuple>

#include "lights/light_data.h"
#include "lights/light_list.h"
#include "lights/light_params.h"
#include "textures/resolve.h"

namespace etd {

const ModelDecl& DiffuseArea::decl() {
  static const ModelDecl d{
      Family::kAreaLight,
      "diffuse",
      "Emits the same radiance to all directions from every point of a shape.",
      {{.name = "L",
        .type = ParamType::kSpectrum,
        .default_value = 1.0,
        .min = 0,
        .unit = "W/(m^2 sr)",
        .doc = "Emitted radiance."},
       filename_param("Image of the radiance over the shape's uv, instead of L; (0, 0) is its lower left corner.",
                      false),
       layer_param(),
       scale_param(),
       power_param(),
       {.name = "twosided",
        .type = ParamType::kBool,
        .default_value = false,
        .doc = "Emit from both sides, not just from that of the surface normal."}}};
  return d;
}

namespace {

// Leaves out "scale" and "power".
AreaEmission read_emission(const ParamReader& p, const AreaLightContext& context) {
  AreaEmission e;
  e.two_sided = p.boolean("twosided");
  e.invisible = context.invisible;
  if (!p.given("filename")) {
    e.radiance = emission_value(p, "L");
    return e;
  }
  const auto [it, is_new] = context.data.image_of.try_emplace(&p.use(), nullptr);
  if (is_new) {
    reject_radiance_beside_file(p);
    if (auto image = read_light_image(p, context.images, context.data))
      it->second = context.data.keep(std::move(image));
  }
  e.image = it->second;
  return e;
}

// Side of the square of points that see every texel of an image spread over so many surfaces.
int points_for(const AreaEmission& emission, size_t surfaces) {
  if (!emission.image) return 1;
  const double texels = 2.0 * std::max(emission.image->width(), emission.image->height());
  return static_cast<int>(std::clamp(std::ceil(texels / std::sqrt(static_cast<double>(surfaces))), 8.0, 1024.0));
}

template <class Surface>
std::vector<DiffuseAreaLight<Surface>> lights_on(const std::vector<Surface>& surfaces, const AreaEmission& emission,
                                                 int points) {
  std::vector<DiffuseAreaLight<Surface>> lights;
  for (const Surface& s : surfaces) lights.emplace_back(emission, s, points);
  return lights;
}

template <class Surface>
Spectrum total_power(const std::vector<DiffuseAreaLight<Surface>>& lights) {
  Spectrum sum;
  for (const auto& light : lights) sum += light.power();
  return sum;
}

}  // namespace

AreaLights DiffuseArea::create(const ParamReader& p, const AreaLightContext& context) {
  const AreaEmission emission = read_emission(p, context);
  const int points = points_for(emission, context.surfaces.size());
  const auto kinds = context.surfaces.with_all(
      [&](const auto&... surfaces) { return std::tuple(lights_on(surfaces, emission, points)...); });
  const Spectrum power = std::apply([](const auto&... lights) { return (total_power(lights) + ...); }, kinds);
  const float scale = emission_scale(p, "power", power);
  AreaLights made{{}, power * scale};
  const auto add = [&](const auto& lights) {
    for (const auto& light : lights) made.lights.push_back(Light(light.scaled(scale)));
  };
  std::apply([&](const auto&... lights) { (add(lights), ...); }, kinds);
  return made;
}

}  // namespace etd
