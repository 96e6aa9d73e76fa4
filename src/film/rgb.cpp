#include "film/rgb.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace etd {
namespace {

PixelBounds intersect(PixelBounds b, int width, int height) {
  return {std::max(b.x0, 0), std::max(b.y0, 0), std::min(b.x1, width), std::min(b.y1, height)};
}

// x0 x1 y0 y1 in [0, 1], in either order, to the pixels whose upper left corner is inside: neighbouring windows share
// no pixel. In float, as pbrt computes it, so that both render the same pixels.
PixelBounds window_to_pixels(const std::vector<double>& w, int width, int height) {
  const auto edge = [](double fraction, int size) {
    return static_cast<int>(std::ceil(static_cast<float>(size) * static_cast<float>(std::clamp(fraction, 0.0, 1.0))));
  };
  return {edge(std::min(w[0], w[1]), width), edge(std::min(w[2], w[3]), height), edge(std::max(w[0], w[1]), width),
          edge(std::max(w[2], w[3]), height)};
}

PixelBounds scale_outward(const std::vector<int32_t>& b, double x, double y) {
  return {static_cast<int>(std::floor(b[0] * x)), static_cast<int>(std::floor(b[2] * y)),
          static_cast<int>(std::ceil(b[1] * x)), static_cast<int>(std::ceil(b[3] * y))};
}

}  // namespace

const ModelDecl& RgbFilm::decl() {
  static const ModelDecl d = with_params(
      {.family = Family::kFilm,
       .name = "rgb",
       .doc = "An image of linear Rec.709 colour, with layers for the components of light, features and errors.",
       .params =
           {
               {.name = "xresolution",
                .type = ParamType::kInteger,
                .default_value = 1280,
                .min = 1,
                .max = kMaxImageSide,
                .unit = "pixels",
                .doc = "Width of the image."},
               {.name = "yresolution",
                .type = ParamType::kInteger,
                .default_value = 720,
                .min = 1,
                .max = kMaxImageSide,
                .unit = "pixels",
                .doc = "Height of the image."},
               {.name = "cropwindow",
                .type = ParamType::kFloat,
                .array = true,
                .min = 0,
                .max = 1,
                .doc = "The part to render, x0 x1 y0 y1, as fractions of the image; goes before pixelbounds."},
               {.name = "pixelbounds",
                .type = ParamType::kInteger,
                .array = true,
                .unit = "pixels",
                .doc = "The part to render, x0 x1 y0 y1; x1 and y1 are outside."},
               {.name = "filename",
                .type = ParamType::kString,
                .default_value = std::string("pbrt.exr"),
                .doc = "Name of the image that is written to the current folder when the command line names none."},
               {.name = "savefp16",
                .type = ParamType::kBool,
                .default_value = false,
                .doc = "EXR files hold 16-bit floats: half the size, three digits, 65504 at most. (pbrt's default is "
                       "true.)"},
           }},
      {Sensor::params()});
  return d;
}

FilmModel RgbFilm::create(const ParamReader& reader, const FilmContext& context) {
  const int own_width = reader.integer("xresolution"), own_height = reader.integer("yresolution");
  FilmModel model;
  FilmSettings& film = model.settings;
  film.width = context.size ? context.size->first : own_width;
  film.height = context.size ? context.size->second : own_height;
  model.filename = reader.string("filename");
  model.half = reader.boolean("savefp16");
  film.sensor = Sensor::create(reader, context.shutter);
  const PixelBounds whole{0, 0, film.width, film.height};
  film.crop = whole;

  Diagnostics& diagnostics = reader.diagnostics();
  const Param* window = reader.given("cropwindow");
  const Param* bounds = reader.given("pixelbounds");
  for (const Param* p : {window, bounds})
    if (p && p->numbers.size() + p->integers.size() != 4) {
      diagnostics.error(p->loc,
                        fmt::format("parameter \"{}\" of film \"{}\" takes 4 numbers", p->name, reader.decl().name),
                        "they are x0 x1 y0 y1");
      return model;
    }
  if (window && bounds)
    diagnostics.warning(bounds->loc, "both \"cropwindow\" and \"pixelbounds\" are given: the crop window counts");
  if (window)
    film.crop = intersect(window_to_pixels(window->numbers, film.width, film.height), film.width, film.height);
  else if (bounds)
    film.crop = intersect(scale_outward(bounds->integers, static_cast<double>(film.width) / own_width,
                                        static_cast<double>(film.height) / own_height),
                          film.width, film.height);
  if (film.crop.empty()) {
    const Param& p = window ? *window : *bounds;
    diagnostics.error(p.value_loc, fmt::format("\"{}\" leaves no pixel of the image to render", p.name),
                      fmt::format("the image is {} x {} pixels; the values are x0 x1 y0 y1", film.width, film.height));
    film.crop = whole;
  }
  return model;
}

}  // namespace etd
