// The family of reconstruction filters, importance sampled: a sample lands where the absolute value of the filter says,
// and the pixel is the plain mean of its weighted samples.
#pragma once

#include <span>

#include "core/tagged.h"
#include "core/vec.h"
#include "params/declaration.h"

namespace etd {

// Range of radii and widths, in pixels: beyond it, sizes and their squares would not all fit a float.
inline constexpr double kMinFilterSize = 1e-6, kMaxFilterSize = 1e6;

struct FilterSample {
  Vec2 offset;       // from the pixel's centre, in pixels
  float weight = 1;  // filter / (its integral x density); mean 1, negative in negative lobes
};

class Filter {
 public:
  Filter() = default;
  template <class T>
  explicit Filter(const T& filter);

  FilterSample sample(Vec2 u) const;
  // The filter divided by its integral.
  float eval(Vec2 offset) const;
  // Half widths of the support, in pixels.
  Vec2 radius() const;

 private:
  TaggedStorage<1088> storage_;
};

std::span<const ModelDecl* const> filter_models();
// Makes the filter of a checked use; the gaussian for an unknown name.
Filter make_filter(const ModelUse& use, Diagnostics& diagnostics);

}  // namespace etd
