// The gaussian filter, lowered so that it reaches zero at its radius.
#pragma once

#include "filters/separable.h"

namespace etd {

// exp(-d^2 / 2 sigma^2) - exp(-r^2 / 2 sigma^2) on [-r, r], divided by 1 - exp(-r^2 / 2 sigma^2), so that it is 1 in
// the middle whatever sigma is: for a wide one it becomes the parabola 1 - d^2 / r^2.
struct GaussianShape {
  float r = 1, sigma = 1;

  // e^-a - e^-b as -e^-a expm1(a - b), which keeps its digits where a and b are small.
  float value(float d) const {
    const float a = sqr(d / sigma) / 2, b = sqr(r / sigma) / 2;
    return d < r ? std::exp(-a) * std::expm1(a - b) / std::expm1(-b) : 0.0f;
  }
  // Beyond 6 sigma lie 2e-9 of the integral; without them a narrow bump keeps its cells.
  float reach() const { return std::min(r, 6.0f * sigma); }
};

struct GaussianFilter : SeparableFilter<GaussianShape> {
  static const ModelDecl& decl() {
    static const ModelDecl d{Family::kFilter,
                             "gaussian",
                             "A gaussian bump, zero at its radius: smooth, slightly blurred.",
                             {{.name = "xradius",
                               .default_value = 1.5,
                               .min = kMinFilterSize,
                               .max = kMaxFilterSize,
                               .unit = "pixels",
                               .doc = "Half width."},
                              {.name = "yradius",
                               .default_value = 1.5,
                               .min = kMinFilterSize,
                               .max = kMaxFilterSize,
                               .unit = "pixels",
                               .doc = "Half height."},
                              {.name = "sigma",
                               .default_value = 0.5,
                               .min = kMinFilterSize,
                               .max = kMaxFilterSize,
                               .unit = "pixels",
                               .doc = "Standard deviation of the bump."}}};
    return d;
  }
  static GaussianFilter create(const ParamReader& p) {
    const auto axis = [&](const char* radius) {
      return FilterAxis(GaussianShape{static_cast<float>(p.number(radius)), static_cast<float>(p.number("sigma"))});
    };
    return {{axis("xradius"), axis("yradius")}};
  }
};

}  // namespace etd
