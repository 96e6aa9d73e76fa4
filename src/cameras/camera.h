// The family of cameras: from a point on the film (and later the lens) to a ray in the recentred world.
#pragma once

#include <span>

#include "core/ray.h"
#include "core/tagged.h"
#include "core/transform.h"
#include "params/declaration.h"

namespace etd {

// What a ray is made from: film in pixels of the full image (x right, y down), lens and time in [0, 1).
struct CameraSample {
  Vec2 film;
  Vec2 lens;
  float time = 0;
};

class Camera {
 public:
  Camera() = default;
  template <class T>
  explicit Camera(const T& camera);

  // A ray of unit direction, weighted 1.
  Ray generate_ray(const CameraSample& sample) const;

 private:
  TaggedStorage<96> storage_;
};

struct CameraFrame {
  Transform camera_to_world;  // to the recentred world
  int width = 0, height = 0;
};

std::span<const ModelDecl* const> camera_models();
// Of a checked use; the perspective camera for an unknown name.
Camera make_camera(const ModelUse& use, const CameraFrame& frame, Diagnostics& diagnostics);

}  // namespace etd
