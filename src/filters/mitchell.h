// The family of cubic filters of Mitchell and Netravali (1988, "Reconstruction Filters in Computer Graphics", eq. 8):
// sharp, at the price of small negative lobes.
#pragma once

#include "filters/separable.h"

namespace etd {

struct MitchellShape {
  float r = 2, b = 1.0f / 3, c = 1.0f / 3;

  float value(float d) const {
    if (!(d < r)) return 0.0f;
    const float x = 2.0f * d / r;
    if (x < 1.0f) return ((12 - 9 * b - 6 * c) * x + (-18 + 12 * b + 6 * c)) * x * x + (6 - 2 * b);
    return (((-b - 6 * c) * x + (6 * b + 30 * c)) * x + (-12 * b - 48 * c)) * x + (8 * b + 24 * c);
  }
  float reach() const { return r; }
};

struct MitchellFilter : SeparableFilter<MitchellShape> {
  static const ModelDecl& decl() {
    static const ModelDecl d{
        Family::kFilter,
        "mitchell",
        "Two cubic polynomials: sharp, with small negative lobes. Pixels at an edge can leave the range of their "
        "sides.",
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
          .doc = "Half height."},
         {.name = "B",
          .default_value = 1.0 / 3,
          .min = -10,
          .max = 10,
          .doc = "Blur: with C = 0, 1 is the cubic B-spline."},
         {.name = "C",
          .default_value = 1.0 / 3,
          .min = -10,
          .max = 10,
          .doc = "Ringing: with B = 0, 0.5 is the Catmull-Rom spline; B + 2 C = 1 is recommended."}}};
    return d;
  }
  static MitchellFilter create(const ParamReader& p) {
    const auto axis = [&](const char* radius) {
      return FilterAxis(MitchellShape{static_cast<float>(p.number(radius)), static_cast<float>(p.number("B")),
                                      static_cast<float>(p.number("C"))});
    };
    return {{axis("xradius"), axis("yradius")}};
  }
};

}  // namespace etd
