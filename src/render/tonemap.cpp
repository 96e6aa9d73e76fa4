#include "render/tonemap.h"

#include <algorithm>
#include <cmath>

#include "spectrum/color_space.h"

namespace etd {
namespace {

double filmic(double x) { return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14); }

double on_screen(double x, ToneOperator curve) {
  x = std::max(x, 0.0);
  return std::min(curve == ToneOperator::kFilmic ? filmic(x) : x, 1.0);
}

}  // namespace

size_t tone_map(std::span<float> rgb, const ToneMapping& mapping) {
  constexpr double kBrightest = 1e9;  // also for infinite values: more than any screen shows, and it can be multiplied
  const double scale = std::exp2(mapping.exposure);
  size_t not_numbers = 0;
  for (size_t i = 0; i + 2 < rgb.size(); i += 3) {
    if (std::isnan(rgb[i]) || std::isnan(rgb[i + 1]) || std::isnan(rgb[i + 2])) {
      ++not_numbers;
      std::fill_n(rgb.begin() + static_cast<std::ptrdiff_t>(i), 3, 0.0f);
      continue;
    }
    const auto bounded = [&](size_t c) { return std::clamp<double>(rgb[i + c], -kBrightest, kBrightest); };
    Vec3d v{bounded(0), bounded(1), bounded(2)};
    if (const auto& m = mapping.balance) v = {dot((*m)[0], v), dot((*m)[1], v), dot((*m)[2], v)};
    rgb[i] = static_cast<float>(on_screen(v.x * scale, mapping.curve));
    rgb[i + 1] = static_cast<float>(on_screen(v.y * scale, mapping.curve));
    rgb[i + 2] = static_cast<float>(on_screen(v.z * scale, mapping.curve));
  }
  return not_numbers;
}

std::optional<std::array<Vec3d, 3>> grey_world_balance(std::span<const float> rgb) {
  Vec3d sum{0, 0, 0};
  for (size_t i = 0; i + 2 < rgb.size(); i += 3) {
    const Vec3d v{rgb[i], rgb[i + 1], rgb[i + 2]};
    if (std::isfinite(v.x + v.y + v.z)) sum = sum + v;
  }
  const bool is_colour = sum.x >= 0 && sum.y >= 0 && sum.z >= 0 && sum.x + sum.y + sum.z > 0;
  if (!is_colour) return {};
  return adapt_rec709(rec709_to_xyz(sum));
}

}  // namespace etd
