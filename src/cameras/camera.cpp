#include "cameras/camera.h"

#include "cameras/camera_list.h"
#include "params/model_list.h"

namespace etd {

void Camera::set_motion(const Shutter& shutter, std::optional<AnimatedTransform> motion) {
  shutter_ = shutter;
  motion_ = std::move(motion);
}

Ray Camera::generate_ray(const CameraSample& sample) const {
  Ray ray = dispatch<Ray, Cameras>(storage_, [&](const auto& c) { return c.generate_ray(sample); });
  ray.time = ray_time(sample.time);
  if (motion_) {
    const Transform t = motion_->at(ray.time);
    ray.o = to_float(t.point(to_double(ray.o)));
    ray.d = normalize(to_float(t.vector(to_double(ray.d))));
  }
  return ray;
}

float Camera::ray_time(float u) const {
  return clamp(static_cast<float>(shutter_.open + (shutter_.close - shutter_.open) * static_cast<double>(u)), 0.0f,
               1.0f);
}

namespace {

// Calls f with the camera as it stands at the time.
template <class R, class Storage, class F>
R at_time(const Storage& storage, const std::optional<AnimatedTransform>& motion, float time, F&& f) {
  return dispatch<R, Cameras>(storage, [&](auto camera) {
    if (motion) camera.move(motion->at(time));
    return f(camera);
  });
}

}  // namespace

bool Camera::on_film(Vec2 film, float margin) const {
  return film.x >= -margin && film.x < size_.x + margin && film.y >= -margin && film.y < size_.y + margin;
}

std::optional<CameraImportance> Camera::we(const Ray& ray, float margin) const {
  using Result = std::optional<CameraImportance>;
  const auto result = at_time<Result>(storage_, motion_, ray.time, [&](const auto& c) { return c.we(ray.o, ray.d); });
  return result && on_film(result->film, margin) ? result : std::nullopt;
}

std::optional<CameraConnection> Camera::sample_wi(Point3 p, Vec2 u_lens, float time, float margin) const {
  using Result = std::optional<CameraConnection>;
  const auto result = at_time<Result>(storage_, motion_, time, [&](const auto& c) { return c.sample_wi(p, u_lens); });
  return result && on_film(result->importance.film, margin) ? result : std::nullopt;
}

bool Camera::film_repeats() const {
  return dispatch<bool, Cameras>(storage_, [](const auto& c) {
    return requires { c.repeated(Vec2(), 0, 0); };
  });
}

Vec2 Camera::repeated(Vec2 film, int column, int row) const {
  return dispatch<Vec2, Cameras>(storage_, [&]([[maybe_unused]] const auto& c) {
    if constexpr (requires { c.repeated(film, column, row); })
      return c.repeated(film, column, row);
    else
      return film;
  });
}

std::span<const ModelDecl* const> camera_models() {
  static const std::vector<const ModelDecl*> all = declarations(Cameras{});
  return all;
}

Camera make_camera(const ModelUse& use, const CameraFrame& frame, CameraData& data, Diagnostics& diagnostics) {
  Camera camera;
  const auto make = [&]<class T>(std::type_identity<T>, const ParamReader& p) {
    camera = Camera(T::create(p, frame, data), frame.width, frame.height);
  };
  if (!with_model(Cameras{}, use, diagnostics, make))
    make(std::type_identity<PerspectiveCamera>(), {PerspectiveCamera::decl(), use, diagnostics});
  return camera;
}

}  // namespace etd
