// The list of filters. To add one: its header, and its name in the list.
#pragma once

#include "filters/box.h"
#include "filters/gaussian.h"
#include "filters/mitchell.h"
#include "filters/sinc.h"
#include "filters/triangle.h"

namespace etd {

using Filters = TypeList<BoxFilter, GaussianFilter, MitchellFilter, SincFilter, TriangleFilter>;

template <class T>
Filter::Filter(const T& filter) {
  storage_.store<Filters>(filter);
}

}  // namespace etd
