// What the checks of the importance of cameras share.
#pragma once

#include "core/hash.h"
#include "verify/battery/camera/camera.h"
#include "verify/battery/worst.h"

namespace etd {

inline Vec2 next_2d(HashStream& numbers) {
  const float x = numbers.next_float(), y = numbers.next_float();
  return {x, y};
}

inline CameraSample next_sample(HashStream& numbers) {
  const Vec2 film = next_2d(numbers), lens = next_2d(numbers);
  return {{film.x * CameraModel::kFilmWidth, film.y * CameraModel::kFilmHeight}, lens, numbers.next_float()};
}

// Tells where a flat film is seen so nearly edge on that rounding shows, and that few samples carry its light.
inline bool is_sideways(const CameraModel& m, Vec3 d) {
  return m.spread == FilmSpread::kFlat && dot(d, m.axis) < 0.05f;
}

// What light paths bring to the film must be what camera paths find: see check_importance().
void check_measurement(const CameraModel& m, size_t samples, uint64_t seed, WorstP& connected, WorstP& chance);

}  // namespace etd
