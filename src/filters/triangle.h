// The tent filter, sampled by inverting its distribution function.
#pragma once

#include "filters/filter.h"

namespace etd {

struct TriangleFilter {
  Vec2 r;  // half widths

  static const ModelDecl& decl() {
    static const ModelDecl d{Family::kFilter,
                             "triangle",
                             "Falls linearly from the pixel's centre.",
                             {{.name = "xradius",
                               .default_value = 2.0,
                               .min = kMinFilterSize,
                               .max = kMaxFilterSize,
                               .unit = "pixels",
                               .doc = "Half width."},
                              {.name = "yradius",
                               .default_value = 2.0,
                               .min = kMinFilterSize,
                               .max = kMaxFilterSize,
                               .unit = "pixels",
                               .doc = "Half height."}}};
    return d;
  }
  static TriangleFilter create(const ParamReader& p) {
    return {{static_cast<float>(p.number("xradius")), static_cast<float>(p.number("yradius"))}};
  }

  static float sample_tent(float u, float r) {
    return u < 0.5f ? r * (std::sqrt(2.0f * u) - 1.0f) : r * (1.0f - std::sqrt(2.0f * (1.0f - u)));
  }
  FilterSample sample(Vec2 u) const { return {{sample_tent(u.x, r.x), sample_tent(u.y, r.y)}, 1.0f}; }
  float eval(Vec2 o) const {
    return std::max(0.0f, r.x - std::abs(o.x)) * std::max(0.0f, r.y - std::abs(o.y)) / sqr(r.x * r.y);
  }
  Vec2 radius() const { return r; }
};

}  // namespace etd
