// The film models as scene files describe them: how large the image is, which part of it is wanted, how it is exposed,
// and what becomes of it.
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

const ModelDecl& rgb_film_decl();
const ModelDecl& gbuffer_film_decl();
std::span<const ModelDecl* const> film_models();

// `size` replaces the resolution: the crop window scales with it, and pixel bounds are scaled outward. Bounds that
// leave nothing of the image are an error; then the crop is the whole image. `shutter` is how long the camera's shutter
// is open, in seconds.
FilmModel read_film_model(const ParamReader& reader, std::optional<std::pair<int, int>> size, double shutter);

}  // namespace etd
