// The list of cameras. To add one: its header, and its name in the list.
#pragma once

#include "cameras/orthographic.h"
#include "cameras/perspective.h"
#include "cameras/spherical.h"

namespace etd {

using Cameras = TypeList<PerspectiveCamera, OrthographicCamera, SphericalCamera>;

template <class T>
Camera::Camera(const T& camera, int width, int height) : size_{static_cast<float>(width), static_cast<float>(height)} {
  storage_.store<Cameras>(camera);
}

}  // namespace etd
