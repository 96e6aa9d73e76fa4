// The family of films as scene files describe them: how large the image is, which part of it is wanted, how it is
// exposed, and what becomes of it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>

#include "film/film.h"
#include "params/declaration.h"

namespace etd {

inline constexpr int kMaxImageSide = 65536;

struct FilmModel {
  FilmSettings settings;  // size, crop (inside the image, not empty), sensor and positions
  std::string filename;
  bool half = false;             // EXR files hold 16-bit floats
  bool in_camera_space = false;  // positions and normals
};

// What a film is made in, beside its parameters.
struct FilmContext {
  // Replaces the resolution: the crop window scales with it, and pixel bounds are scaled outward.
  std::optional<std::pair<int, int>> size = {};
  double shutter = 1;  // how long the camera's shutter is open, in seconds
};

std::span<const ModelDecl* const> film_models();
// Makes the film of a checked use; that of "rgb" for an unknown name.
FilmModel make_film_model(const ModelUse& use, const FilmContext& context, Diagnostics& diagnostics);

}  // namespace etd
