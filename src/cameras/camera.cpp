// The list of cameras and their dispatch. To add one: its header, its name in the lists, its constructor line.
#include "cameras/camera.h"

#include "cameras/perspective.h"

namespace etd {

namespace {
using Cameras = TypeList<PerspectiveCamera>;
}  // namespace

template <class T>
Camera::Camera(const T& camera) {
  storage_.store<Cameras>(camera);
}
template Camera::Camera(const PerspectiveCamera&);

Ray Camera::generate_ray(const CameraSample& sample) const {
  return dispatch<Ray, Cameras>(storage_, [&](const auto& c) { return c.generate_ray(sample); });
}

std::span<const ModelDecl* const> camera_models() {
  static const ModelDecl* const all[] = {&PerspectiveCamera::decl()};
  return all;
}

Camera make_camera(const ModelUse& use, const CameraFrame& frame, Diagnostics& diagnostics) {
  return Camera(PerspectiveCamera::create({PerspectiveCamera::decl(), use, diagnostics}, frame));
}

}  // namespace etd
