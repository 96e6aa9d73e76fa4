// The box filter: every sample of the support counts the same.
#pragma once

#include "filters/filter.h"

namespace etd {

struct BoxFilter {
  Vec2 r;  // half widths

  static const ModelDecl& decl() {
    static const ModelDecl d{Family::kFilter,
                             "box",
                             "Constant over the pixel: no correlation between pixels.",
                             {{.name = "xradius",
                               .default_value = 0.5,
                               .min = kMinFilterSize,
                               .max = kMaxFilterSize,
                               .unit = "pixels",
                               .doc = "Half width."},
                              {.name = "yradius",
                               .default_value = 0.5,
                               .min = kMinFilterSize,
                               .max = kMaxFilterSize,
                               .unit = "pixels",
                               .doc = "Half height."}}};
    return d;
  }
  static BoxFilter create(const ParamReader& p) {
    return {{static_cast<float>(p.number("xradius")), static_cast<float>(p.number("yradius"))}};
  }

  FilterSample sample(Vec2 u) const { return {{(2 * u.x - 1) * r.x, (2 * u.y - 1) * r.y}, 1.0f}; }
  float eval(Vec2 o) const { return std::abs(o.x) <= r.x && std::abs(o.y) <= r.y ? 1.0f / (4.0f * r.x * r.y) : 0.0f; }
  Vec2 radius() const { return r; }
};

}  // namespace etd
