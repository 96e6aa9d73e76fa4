// The film model "rgb" as scene files describe it: how large the image is, which part of it is wanted, and its name.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>

#include "core/bounds.h"
#include "params/declaration.h"

namespace etd {

inline constexpr int kMaxImageSide = 65536;

struct RgbFilm {
  int width = 0, height = 0;
  PixelBounds crop;  // inside the image, not empty
  std::string filename;
};

const ModelDecl& rgb_film_decl();
std::span<const ModelDecl* const> film_models();

// `size` replaces the resolution: the crop window scales with it, and pixel bounds are scaled outward. Bounds that
// leave nothing of the image are an error; then the crop is the whole image.
RgbFilm read_rgb_film(const ParamReader& reader, std::optional<std::pair<int, int>> size);

}  // namespace etd
