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

  ETD_FN static float get_1d(const SampleNumber& n) { return unit_float(static_cast<uint32_t>(bits(n))); }
  ETD_FN static Vec2 get_2d(const SampleNumber& n) {
    const uint64_t b = bits(n);
    return {unit_float(static_cast<uint32_t>(b)), unit_float(static_cast<uint32_t>(b >> 32))};
  }
  ETD_FN static uint64_t get_bits(const SampleNumber& n) { return bits(n); }

 private:
  ETD_FN static uint64_t bits(const SampleNumber& n) { return hash_combine(n.hash(), n.index); }
};

}  // namespace etd
