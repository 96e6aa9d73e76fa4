// What a scene's roughness means to a microfacet closure: the one place that knows the remapping and where a lobe
// becomes a mirror.
#pragma once

#include <optional>

#include "core/vec.h"

namespace etd {

// The widths (alpha along x and y) of the microfacet distribution, or nothing where the surface counts as smooth and a
// delta lobe is to be used. `remap` takes alpha = sqrt(roughness); negative and undefined roughness count as 0.
// Thresholds: docs/conventions.md.
ETD_FN std::optional<Vec2> microfacet_alpha(float roughness_x, float roughness_y, bool remap) {
  constexpr float kSmooth = 1e-3f, kSmallest = 1e-4f;
  const auto alpha = [remap](float r) { return remap ? safe_sqrt(r) : (r > 0.0f ? r : 0.0f); };
  const float ax = alpha(roughness_x), ay = alpha(roughness_y);
  if (std::max(ax, ay) < kSmooth) return {};
  return Vec2{std::max(ax, kSmallest), std::max(ay, kSmallest)};
}

}  // namespace etd
