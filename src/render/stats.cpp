#include "render/stats.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace etd {

void count_pixels(const Film& film, RenderStats& stats) {
  const PixelBounds& crop = film.settings().crop;
  double samples = 0, rays = 0, most = 0;
  for (int y = crop.y0; y < crop.y1; ++y)
    for (int x = crop.x0; x < crop.x1; ++x) {
      const PixelSums sums = film.total(x, y);
      samples += sums.count;
      rays += sums.rays;
      most = std::max(most, sums.rays);
    }
  stats.paths = static_cast<uint64_t>(samples);
  stats.rays_per_pixel_mean = crop.empty() ? 0 : rays / (static_cast<double>(crop.width()) * crop.height());
  stats.rays_per_pixel_max = most;
}

std::string stats_json(const RenderStats& s) {
  nlohmann::ordered_json json;
  json["seconds"] = {{"load", s.load_seconds},
                     {"build", s.build_seconds},
                     {"first_pass", s.first_pass_seconds},
                     {"render", s.render_seconds}};
  json["rays"] = {{"camera", s.rays.camera}, {"indirect", s.rays.indirect}, {"shadow", s.rays.shadow}};
  json["rays_per_pixel"] = {{"mean", s.rays_per_pixel_mean}, {"max", s.rays_per_pixel_max}};
  json["invalid"] = {{"nan", s.invalid.nan}, {"infinite", s.invalid.infinite}, {"negative", s.invalid.negative}};
  json["paths"] = s.paths;
  json["peak_bytes"] = s.peak_bytes;
  json["memory"] = {
      {"load_peak", s.load_peak_bytes}, {"geometry", s.geometry_bytes}, {"accelerator", s.accelerator_bytes}};
  json["texture_bytes"] = s.texture_bytes;
  json["spp"] = s.spp;
  return json.dump(2) + "\n";
}

}  // namespace etd
