#include "integrators/transport_params.h"

#include <algorithm>

namespace etd {

std::vector<ParamDecl> transport_params(int roulette_depth, int deepest) {
  return {{.name = "maxdepth",
           .type = ParamType::kInteger,
           .default_value = 5,
           .min = 0,
           .max = static_cast<double>(deepest),
           .doc = "Scattering events of the longest path: 0 shows emitters, 1 direct light, 2 one bounce more."},
          {.name = "components",
           .type = ParamType::kString,
           .default_value = std::string("all"),
           .choices = {"all", "emission", "direct", "indirect"},
           .doc = "Which part of the light to render."},
          {.name = "roulettedepth",
           .type = ParamType::kInteger,
           .default_value = roulette_depth,
           .min = 1,
           .max = static_cast<double>(deepest),
           .doc = "Scattering events after which Russian roulette may end a path; never changes the mean."},
          light_sampler_param()};
}

TransportSettings transport_settings(const ParamReader& p) {
  TransportSettings s;
  const std::string components = p.string("components");
  const bool all = components == "all";
  s.emission = all || components == "emission";
  s.direct = all || components == "direct";
  s.indirect = all || components == "indirect";
  s.max_depth = p.integer("maxdepth");
  // No path is longer than the deepest component that is kept.
  if (!s.indirect) s.max_depth = std::min(s.max_depth, s.direct ? 1 : 0);
  s.roulette_depth = p.integer("roulettedepth");
  s.light_sampler = p.string("lightsampler");
  return s;
}

LightSampler light_sampler_of(const Scene& scene, const TransportSettings& settings) {
  const std::string& name = settings.light_sampler;
  if (name.empty() || name == scene.light_sampler.name()) return scene.light_sampler;
  return make_light_sampler(name, {scene.lights, scene.viewer});
}

ParamDecl paths_from_lights_param() {
  return {.name = "paths",
          .type = ParamType::kString,
          .default_value = std::string("all"),
          .choices = {"all", "from_camera"},
          .doc =
              "Which paths to render: all, or those alone that the integrator path finds too. It misses light of "
              "points and single directions that a mirror or clear glass is the first to scatter."};
}

bool leaves_out_what_the_camera_misses(const ParamReader& p) { return p.string("paths") == "from_camera"; }

}  // namespace etd
