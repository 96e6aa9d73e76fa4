#include "integrators/camera_splat.h"

#include <algorithm>

namespace etd {

namespace {

// The pixels of a row or column whose centres are within `radius` of `film`.
struct PixelRange {
  int begin, end;
  PixelRange(float film, float radius, int size)
      : begin(static_cast<int>(std::max(std::ceil(film - radius - 0.5f), 0.0f))),
        end(static_cast<int>(std::min(std::floor(film + radius - 0.5f) + 1.0f, static_cast<float>(size)))) {}
};

// How many copies of a film of this size a filter reaches beyond each of its edges.
int copies(float radius, int size) { return static_cast<int>(std::ceil(radius / static_cast<float>(size))); }

}  // namespace

void CameraSplat::add(Sink& sink, Vec2 film, int depth, const Spectrum& light, uint32_t number) const {
  Sink::Splat splat(sink, depth, light, {static_cast<int>(film.x), static_cast<int>(film.y), number});
  if (!scene_.camera.film_repeats()) return add_once(splat, film);
  const int columns = copies(radius_.x, width_), rows = copies(radius_.y, height_);
  for (int row = -rows; row <= rows; ++row)
    for (int column = -columns; column <= columns; ++column) add_once(splat, scene_.camera.repeated(film, column, row));
}

void CameraSplat::add_once(Sink::Splat& splat, Vec2 film) const {
  const PixelRange xs(film.x, radius_.x, width_), ys(film.y, radius_.y, height_);
  for (int y = ys.begin; y < ys.end; ++y)
    for (int x = xs.begin; x < xs.end; ++x) {
      const Vec2 offset{film.x - (static_cast<float>(x) + 0.5f), film.y - (static_cast<float>(y) + 0.5f)};
      const float weight = scene_.filter.eval(offset);
      if (weight != 0.0f) splat.add(x, y, weight);
    }
}

}  // namespace etd
