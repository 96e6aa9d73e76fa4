#include "recorded_paths.h"

#include <algorithm>
#include <stdexcept>

#include "accel/spawn.h"
#include "formats/pbrt/reader.h"

namespace etd {

PreparedRender load_for_bench(const std::filesystem::path& scene, const RenderOverrides& overrides) {
  Diagnostics diagnostics;
  const SceneDescription description = read_pbrt(scene, diagnostics);
  std::optional<PreparedRender> prepared = prepare_render(description, overrides, diagnostics);
  if (!prepared) throw std::runtime_error(diagnostics.format_all());
  return std::move(*prepared);
}

void for_each_path(const PreparedRender& prepared, const std::function<void(const PathRecord&)>& f) {
  const PixelBounds& crop = prepared.settings.film.crop;
  const int tile = prepared.settings.tile_size;
  for (int top = crop.y0; top < crop.y1; top += tile)
    for (int left = crop.x0; left < crop.x1; left += tile)
      for (int y = top; y < std::min(top + tile, crop.y1); ++y)
        for (int x = left; x < std::min(left + tile, crop.x1); ++x)
          for (uint32_t number = 0; number < prepared.settings.spp; ++number) {
            PathRecord path;
            if (!prepared.integrator->replay({x, y, number}, path) || path.vertices.empty())
              throw std::runtime_error("this integrator tells nothing of its paths");
            f(path);
          }
}

void for_each_ray(const PreparedRender& prepared, const PathRecord& path,
                  const std::function<void(RayKind, const Ray&)>& f) {
  const Scene& scene = *prepared.compiled.scene;
  Ray ray = path.ray;
  for (size_t i = 0; i < path.vertices.size(); ++i) {
    f(i == 0 ? RayKind::kCamera : RayKind::kIndirect, ray);
    const PathVertex& v = path.vertices[i];
    if (!v.on_surface) return;
    const SurfacePoint& point = v.surface.point;
    // Next-event estimation asks for visibility only where the light would count.
    if (v.light && v.light->sample && !is_black(v.light->f_cos)) {
      const LightSample& s = *v.light->sample;
      const bool infinite = scene.lights[v.light->light].is_infinite();
      f(RayKind::kShadow, infinite ? spawn_ray(point, s.wi, ray) : shadow_ray(point, s.on_light, ray));
    }
    if (i + 1 < path.vertices.size()) ray = spawn_ray(point, v.scatter->wi, ray);
  }
}

}  // namespace etd
