// The family of cameras: from a point on the film and one on the lens to a ray in the recentred world.
#pragma once

#include <deque>
#include <optional>
#include <span>

#include "cameras/importance.h"
#include "cameras/shutter.h"
#include "core/animated_transform.h"
#include "core/distribution.h"
#include "core/ray.h"
#include "core/tagged.h"
#include "core/transform.h"
#include "io/named_images.h"
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
  Camera(const T& camera, int width, int height);

  // When rays start, with 0 and 1 the start and the end of the scene's motion; before and after they are those. A
  // motion carries the camera from the space in which it was made.
  void set_motion(const Shutter& shutter, std::optional<AnimatedTransform> motion);

  // A ray of unit direction, weighted 1.
  Ray generate_ray(const CameraSample& sample) const;
  // The time of a ray that is made with this CameraSample::time.
  float ray_time(float u) const;

  // Returns the importance of a ray of unit direction that starts on the lens, at its time. Film positions may be up to
  // `margin` pixels beyond the film, from where filters spread light onto it; those of a spherical camera, whose film
  // has no beyond, are on it. Nothing if the camera makes no such ray: it starts beside the lens or in front of it (up
  // to rounding), or goes to where the film is not. Nothing also of an orthographic camera that `blurs_alike`: its rays
  // have lost from which point of the film they are.
  std::optional<CameraImportance> we(const Ray& ray, float margin = 0) const;
  // The way from p (recentred world) at a ray's time to a point of the lens, in proportion to the aperture: u_lens in
  // [0, 1)^2. Nothing if the camera does not see p through that point on the film or within the margin.
  std::optional<CameraConnection> sample_wi(Point3 p, Vec2 u_lens, float time, float margin = 0) const;

  // Whether the film goes on beyond its edges, where the same directions come again: a filter at an edge then takes
  // light from there, and brings light from there to pixels.
  bool film_repeats() const;
  // Where a film position stands again in the copy of the film that is `column` widths to the right and `row` heights
  // further down; only of a film that repeats.
  Vec2 repeated(Vec2 film, int column, int row) const;

 private:
  bool on_film(Vec2 film, float margin) const;

  TaggedStorage<144> storage_;
  Vec2 size_;  // of the film, in pixels
  Shutter shutter_;
  std::optional<AnimatedTransform> motion_;
};

struct CameraFrame {
  Transform camera_to_world;  // to the recentred world
  int width = 0, height = 0;
  ImageSource images = {};  // that apertures name
};

// What cameras are too small to hold themselves. Nothing in it moves while cameras are made.
struct CameraData {
  std::deque<GridDistribution> apertures;
};

std::span<const ModelDecl* const> camera_models();
// Makes the camera of a checked use; the perspective one for an unknown name.
Camera make_camera(const ModelUse& use, const CameraFrame& frame, CameraData& data, Diagnostics& diagnostics);

}  // namespace etd
