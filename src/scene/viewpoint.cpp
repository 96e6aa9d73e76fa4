#include "scene/viewpoint.h"

#include "cameras/camera.h"
#include "core/animated_transform.h"
#include "scene/registry.h"

namespace etd {

Viewpoint viewpoint_of(const SceneDescription& description, const CompileOptions& options) {
  const ModelDecl* decl = find_model(Family::kCamera, description.camera.model);
  const TransformPair& pair = description.camera_to_world;
  if (!decl || pair.start.is_singular() || pair.end.is_singular()) return {};
  Diagnostics unheard;
  const Shutter shutter =
      read_shutter({*decl, description.camera, unheard}).within(description.motion_start, description.motion_end);
  Viewpoint view;
  view.time = std::clamp(0.5 * (shutter.open + shutter.close), 0.0, 1.0);
  // A camera of the same kind at the origin: rays of some cameras do not start at that of their space.
  const Transform to_world = TransformPath().then(pair).at(view.time);
  const Point3d middle = to_world.point({0, 0, 0});
  CameraData data;
  const Camera camera = make_camera(
      description.camera,
      {Transform::translate(Point3d{} - middle) * to_world, options.width, options.height, description.image_source()},
      data, unheard);
  const Ray ray = camera.generate_ray(
      {{0.5f * static_cast<float>(options.width), 0.5f * static_cast<float>(options.height)}, {0.5f, 0.5f}, 0});
  view.position = middle + to_double(ray.o - Point3{});
  return view;
}

}  // namespace etd
