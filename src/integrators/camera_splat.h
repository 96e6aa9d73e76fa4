// Brings light that arrives at a point of the film to the pixels whose filters reach it.
#pragma once

#include "film/sink.h"
#include "scene/scene.h"

namespace etd {

class CameraSplat {
 public:
  // `width` and `height` are those of the full image, in pixels.
  CameraSplat(const Scene& scene, int width, int height)
      : scene_(scene), width_(width), height_(height), radius_(scene.filter.radius()) {}

  // How far beyond the film filters reach, in pixels.
  float margin() const { return std::max(radius_.x, radius_.y); }
  // `film` is a position in pixels; the rest as in Sink::Splat, with `number` that of the sample that the path belongs
  // to. Where the film repeats, its edges are joined as those of the sphere of directions are.
  void add(Sink& sink, Vec2 film, int depth, const Spectrum& light, uint32_t number) const;

 private:
  void add_once(Sink::Splat& splat, Vec2 film) const;

  const Scene& scene_;
  int width_, height_;
  Vec2 radius_;
};

}  // namespace etd
