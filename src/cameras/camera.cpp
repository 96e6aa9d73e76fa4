// The list of cameras and their dispatch. To add one: its header, its name in the lists, its constructor line.
#include "cameras/camera.h"

#include "cameras/orthographic.h"
#include "cameras/perspective.h"
#include "cameras/spherical.h"

namespace etd {

namespace {
using Cameras = TypeList<OrthographicCamera, PerspectiveCamera, SphericalCamera>;
}  // namespace

template <class T>
Camera::Camera(const T& camera) {
  storage_.store<Cameras>(camera);
}
template Camera::Camera(const OrthographicCamera&);
template Camera::Camera(const PerspectiveCamera&);
template Camera::Camera(const SphericalCamera&);

void Camera::set_motion(const Shutter& shutter, std::optional<AnimatedTransform> motion) {
  shutter_ = shutter;
  motion_ = std::move(motion);
}

Ray Camera::generate_ray(const CameraSample& sample) const {
  Ray ray = dispatch<Ray, Cameras>(storage_, [&](const auto& c) { return c.generate_ray(sample); });
  const double u = static_cast<double>(sample.time);
  ray.time = clamp(static_cast<float>(shutter_.open + (shutter_.close - shutter_.open) * u), 0.0f, 1.0f);
  if (motion_) {
    const Transform t = motion_->at(ray.time);
    ray.o = to_float(t.point(to_double(ray.o)));
    ray.d = normalize(to_float(t.vector(to_double(ray.d))));
  }
  return ray;
}

std::span<const ModelDecl* const> camera_models() {
  static const ModelDecl* const all[] = {&PerspectiveCamera::decl(), &OrthographicCamera::decl(),
                                         &SphericalCamera::decl()};
  return all;
}

Camera make_camera(const ModelUse& use, const CameraFrame& frame, CameraData& data, Diagnostics& diagnostics) {
  const auto reader = [&](const ModelDecl& decl) { return ParamReader(decl, use, diagnostics); };
  if (use.model == "orthographic")
    return Camera(OrthographicCamera::create(reader(OrthographicCamera::decl()), frame, data));
  if (use.model == "spherical") return Camera(SphericalCamera::create(reader(SphericalCamera::decl()), frame));
  return Camera(PerspectiveCamera::create(reader(PerspectiveCamera::decl()), frame, data));
}

}  // namespace etd
