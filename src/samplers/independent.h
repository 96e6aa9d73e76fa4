// Plain random numbers.
#pragma once

#include "samplers/sampler.h"

namespace etd {

struct IndependentSampler {
  static constexpr SamplerTraits kTraits{};
  static const ModelDecl& decl() {
    static const ModelDecl d{Family::kSampler, "independent",
                             "Every number independent of every other: the textbook Monte Carlo estimate.",
                             sampler_params()};
    return d;
  }

  ETD_FN static Digits digits(const SampleNumber& n) {
    const uint64_t bits = hash_combine(n.hash(), n.index);
    return {static_cast<uint32_t>(bits), static_cast<uint32_t>(bits >> 32)};
  }
};

}  // namespace etd
