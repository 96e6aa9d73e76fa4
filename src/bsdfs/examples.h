// The closures that are tested: one list, which the battery, the benchmarks and whoever else wants "all closures" walk
// through. A new closure adds its lines here and is tested from then on.
#pragma once

#include <span>
#include <string>

#include "bsdfs/bsdf.h"

namespace etd {

struct BsdfExample {
  std::string name;  // closure and parameters; unique
  Bsdf bsdf;
  bool lossless = false;  // with these parameters all importance that arrives leaves again: a furnace shows 1
  // Histograms are compared only for |cos wo| above this: at grazing incidence a sharp lobe becomes so narrow that
  // directions in float no longer resolve it.
  float min_cos = 0;
};

// The same list at every call, in a fixed order.
std::span<const BsdfExample> bsdf_examples();

}  // namespace etd
