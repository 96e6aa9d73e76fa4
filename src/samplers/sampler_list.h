// The list of samplers. To add one: its header, and its name in the list. A type T of it has T::decl(), whose
// parameters are sampler_params() at least, T::kTraits, and digits(), a function of nothing but the number's place.
#pragma once

#include "samplers/independent.h"
#include "samplers/sobol.h"

namespace etd {

using Samplers = TypeList<IndependentSampler, SobolSampler>;

template <class T>
SamplerKind::SamplerKind(const T& kind) {
  storage_.store<Samplers>(kind);
}

}  // namespace etd
