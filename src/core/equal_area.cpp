#include "core/equal_area.h"

namespace etd {

// The upper hemisphere fills the diamond |a| + |b| <= 1 of the square [-1, 1]^2, the lower one what is beyond, mirrored
// in the diamond's edges. Within a quadrant of the diamond, r = |a| + |b| = sqrt(1 - z) makes rings of the right area,
// and the angle is spread evenly along each ring.
Vec3 equal_area_direction(Vec2 st) {
  const float a = 2.0f * st.x - 1.0f, b = 2.0f * st.y - 1.0f;
  const float inside = 1.0f - std::abs(a) - std::abs(b);  // negative in the lower hemisphere
  const float r = 1.0f - std::abs(inside);
  const float phi = r > 0.0f ? (kPi / 4.0f) * (1.0f + (std::abs(b) - std::abs(a)) / r) : 0.0f;
  const float sin_theta = r * safe_sqrt(2.0f - r * r);
  return {std::copysign(sin_theta * std::cos(phi), a), std::copysign(sin_theta * std::sin(phi), b),
          std::copysign(1.0f - r * r, inside)};
}

Vec2 equal_area_square(Vec3 w) {
  // 1 - |z| without cancellation near the poles.
  const float r = safe_sqrt((w.x * w.x + w.y * w.y) / (1.0f + std::abs(w.z)));
  const float across = r * std::atan2(std::abs(w.y), std::abs(w.x)) * (2.0f * kInvPi);
  float a = r - across, b = across;
  if (w.z < 0.0f) {
    const float folded = 1.0f - b;
    b = 1.0f - a;
    a = folded;
  }
  return {0.5f + 0.5f * std::copysign(a, w.x), 0.5f + 0.5f * std::copysign(b, w.y)};
}

namespace {

// Brings `along` back into [0, 1]. Each edge that is crossed turns the square by half a turn about the edge's middle.
void wrap(float& along, float& across) {
  const float squares = std::floor(along);
  along -= squares;
  if (std::fmod(squares, 2.0f) == 0.0f) return;
  along = 1.0f - along;
  across = 1.0f - across;
}

}  // namespace

Vec2 wrap_equal_area_square(Vec2 st) {
  if (st.x < 0.0f || st.x > 1.0f) wrap(st.x, st.y);
  if (st.y < 0.0f || st.y > 1.0f) wrap(st.y, st.x);
  return st;
}

}  // namespace etd
