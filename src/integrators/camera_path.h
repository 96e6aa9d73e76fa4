// The camera's side of a path, which all integrators share that follow paths from the camera: film, filter, lens, time
// and ray, and what a sample tells of the scene beside its light.
#pragma once

#include "film/pixel_sample.h"
#include "materials/surface_scatter.h"
#include "samplers/sampler.h"
#include "scene/scene.h"

namespace etd {

// Sampler dimensions of the start: film, lens and time.
inline constexpr uint32_t kCameraDimensions = 4;

struct CameraPathStart {
  CameraSample sample;
  Ray ray;
};

// Draws a sample of a pixel (full-image coordinates) and notes the filter's weight and the place on the film in `out`.
// `time`, in [0, 1), is where the shutter's interval is cut; without one, each sample draws its own.
inline CameraPathStart start_camera_path(const Scene& scene, int x, int y, Sampler& sampler, PixelSample& out,
                                         std::optional<float> time = {}) {
  const FilterSample film = scene.filter.sample(sampler.get_2d());
  out.weight = film.weight;
  out.distance2 = sqr(film.offset.x) + sqr(film.offset.y);
  CameraSample at{{static_cast<float>(x) + 0.5f + film.offset.x, static_cast<float>(y) + 0.5f + film.offset.y},
                  sampler.get_2d(),
                  0.0f};
  if (scene.moves) at.time = time ? *time : sampler.get_1d();
  return {at, scene.camera.generate_ray(at)};
}

// Takes the features of a path: alpha and ids where it first meets a surface, the others at the first one that is
// neither a mirror nor clear glass.
class PathFeatures {
 public:
  void meet(const Scene& scene, int depth, const Hit& hit, PixelSample& out) {
    length_ += hit.t;
    if (depth == 0) out.alpha = 1.0f, out.ids = scene.ids_of(hit);
  }
  void shade(const SurfacePoint& point, const SurfaceScatter& scatter, Vec3 wo, PixelSample& out) {
    const Bsdf& bsdf = scatter.bsdf();
    if (!pending_ || (!bsdf.has_smooth_lobe() && (bsdf.lobes() & kDelta))) return;
    out.albedo = scatter.albedo(wo);
    out.normal = scatter.visible_normal(wo);
    out.position = point.p - Point3();
    out.depth = length_;
    out.coverage = 1.0f;
    pending_ = false;
  }

 private:
  bool pending_ = true;
  float length_ = 0;
};

}  // namespace etd
