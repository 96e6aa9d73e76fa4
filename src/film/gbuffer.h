// The film that also tells where what the camera sees is.
#pragma once

#include "film/rgb.h"

namespace etd {

struct GBufferFilm {
  static const ModelDecl& decl() {
    static const ModelDecl d = with_params(
        {.family = Family::kFilm,
         .name = "gbuffer",
         .doc = "The film \"rgb\" with one more layer, of positions; it and normals are in the space that is wanted.",
         .params = {}},
        {RgbFilm::decl().params,
         {{.name = "coordinatesystem",
           .type = ParamType::kString,
           .default_value = std::string("camera"),
           .choices = {"camera", "world"},
           .doc = "The space of the layers of normals and positions."}}});
    return d;
  }
  static FilmModel create(const ParamReader& p, const FilmContext& context) {
    FilmModel model = RgbFilm::create(p, context);
    model.settings.positions = true;
    model.in_camera_space = p.string("coordinatesystem") == "camera";
    return model;
  }
};

}  // namespace etd
