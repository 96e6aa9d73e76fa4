// The family of cameras: from a point on the film and one on the lens to a ray in the recentred world.
#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <span>

#include "cameras/shutter.h"
#include "core/animated_transform.h"
#include "core/distribution.h"
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

  // When rays start, with 0 and 1 the start and the end of the scene's motion; before and after they are those. A
  // motion carries the camera from the space in which it was made.
  void set_motion(const Shutter& shutter, std::optional<AnimatedTransform> motion);

  // A ray of unit direction, weighted 1.
  Ray generate_ray(const CameraSample& sample) const;

 private:
  TaggedStorage<144> storage_;
  Shutter shutter_;
  std::optional<AnimatedTransform> motion_;
};

struct CameraFrame {
  Transform camera_to_world;  // to the recentred world
  int width = 0, height = 0;
  std::filesystem::path folder;  // that file names start from
};

// What cameras are too small to hold themselves. Nothing in it moves while cameras are made.
struct CameraData {
  std::deque<GridDistribution> apertures;
};

std::span<const ModelDecl* const> camera_models();
// Of a checked use; the perspective camera for an unknown name.
Camera make_camera(const ModelUse& use, const CameraFrame& frame, CameraData& data, Diagnostics& diagnostics);

}  // namespace etd
