// What a render cost, as numbers for programs: the file that --stats writes.
#pragma once

#include <string>

#include "film/film.h"
#include "film/invalid_samples.h"

namespace etd {

struct RenderStats {
  double load_seconds = 0, build_seconds = 0, render_seconds = 0;
  double first_pass_seconds = 0;  // of render_seconds, until every pixel has its first samples
  RayCounts rays;
  double rays_per_pixel_mean = 0, rays_per_pixel_max = 0;  // over all samples of a pixel
  InvalidSamples invalid;
  uint64_t paths = 0;              // samples taken, over all pixels
  uint64_t peak_bytes = 0;         // of the process
  uint64_t load_peak_bytes = 0;    // of the process, when the scene was loaded
  uint64_t geometry_bytes = 0;     // of meshes and other shapes
  uint64_t accelerator_bytes = 0;  // of the acceleration structure beside them, as Embree counts it
  uint64_t texture_bytes = 0;      // of images of textures, at the end
  uint32_t spp = 0;                // that every pixel has
};

// Fills in what the film knows: paths and rays per pixel.
void count_pixels(const Film& film, RenderStats& stats);
// {"seconds": {"load", "build", "first_pass", "render"}, "rays": {"camera", "indirect", "shadow"}, "rays_per_pixel":
// {"mean", "max"}, "invalid": {"nan", "infinite", "negative"}, "paths", "peak_bytes", "memory": {"load_peak",
// "geometry", "accelerator"}, "texture_bytes", "spp"}, ending with a newline.
std::string stats_json(const RenderStats& stats);

}  // namespace etd
