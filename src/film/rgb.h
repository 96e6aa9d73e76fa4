// The film of colour images, on which other films are built.
#pragma once

#include "film/film_model.h"

namespace etd {

struct RgbFilm {
  static const ModelDecl& decl();
  // Makes any film that has the parameters of this one. Bounds that leave nothing of the image are an error; then the
  // crop is the whole image.
  static FilmModel create(const ParamReader& p, const FilmContext& context);
};

}  // namespace etd
