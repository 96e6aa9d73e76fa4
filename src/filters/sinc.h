// The sinc, which cuts off frequencies exactly, under a window that is a wider sinc (Lanczos; Duchon 1979, "Lanczos
// Filtering in One and Two Dimensions"): sharp, with negative lobes.
#pragma once

#include "filters/separable.h"

namespace etd {

struct SincShape {
  float r = 4, tau = 3;

  static float sinc(float x) {
    const float a = kPi * x;
    return a < 1e-3f ? 1.0f - a * a / 6.0f : std::sin(a) / a;
  }
  float value(float d) const { return d < r ? sinc(d) * sinc(d / tau) : 0.0f; }
  float reach() const { return r; }
};

struct SincFilter : SeparableFilter<SincShape> {
  static const ModelDecl& decl() {
    constexpr double kWidest = 32;  // and the narrowest window: the table of an axis has 64 cells for all lobes
    static const ModelDecl d{
        Family::kFilter,
        "sinc",
        "A windowed sinc: sharp, with negative lobes. Pixels at an edge can leave the range of their sides.",
        {{.name = "xradius",
          .default_value = 4.0,
          .min = kMinFilterSize,
          .max = kWidest,
          .unit = "pixels",
          .doc = "Half width."},
         {.name = "yradius",
          .default_value = 4.0,
          .min = kMinFilterSize,
          .max = kWidest,
          .unit = "pixels",
          .doc = "Half height."},
         {.name = "tau",
          .default_value = 3.0,
          .min = 0.1,
          .max = kMaxFilterSize,
          .unit = "pixels",
          .doc = "Where the window sinc(x / tau) becomes zero for the first time; it is not cut there, but at the "
                 "radius."}}};
    return d;
  }
  static SincFilter create(const ParamReader& p) {
    const auto axis = [&](const char* radius) {
      return FilterAxis(SincShape{static_cast<float>(p.number(radius)), static_cast<float>(p.number("tau"))});
    };
    return {{axis("xradius"), axis("yradius")}};
  }
};

}  // namespace etd
