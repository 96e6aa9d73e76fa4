#include "verify/battery/bare_scene.h"

#include "scene/compile.h"

namespace etd {

SceneDescription bare_description() {
  SceneDescription d;
  d.camera.model = "perspective";
  d.film.model = "rgb";
  d.filter.model = "gaussian";
  d.sampler.model = "sobol";
  d.integrator.model = "path";
  return d;
}

BareScene compile_bare(const SceneDescription& description, int width, int height) {
  Diagnostics diagnostics;
  BareScene bare{compile(description, {.width = width, .height = height}, diagnostics).scene, {}};
  if (!bare.scene) bare.problem = diagnostics.format_all();
  return bare;
}

}  // namespace etd
