// Sobol's points with Owen scrambling (samplers/owen_sobol.h).
#pragma once

#include "samplers/owen_sobol.h"
#include "samplers/sampler.h"

namespace etd {

struct SobolSampler {
  static constexpr SamplerTraits kTraits{.stratified = true};
  static const ModelDecl& decl() {
    static const ModelDecl d{Family::kSampler, "sobol",
                             "Owen-scrambled Sobol points, padded pair by pair: the least error for equal samples.",
                             sampler_params()};
    return d;
  }

  ETD_FN static float get_1d(const SampleNumber& n) { return unit_float(digits(n, n.hash())); }
  ETD_FN static Vec2 get_2d(const SampleNumber& n) {
    const uint64_t h = n.hash();
    const uint32_t i = shuffled_index(n.index, static_cast<uint32_t>(h));
    return {unit_float(owen_sobol_x(i, static_cast<uint32_t>(h >> 32))),
            unit_float(owen_sobol_y(i, static_cast<uint32_t>(mix_bits(h))))};
  }
  // Behind the 32 digits that an index has, an Owen scramble is plain noise.
  ETD_FN static uint64_t get_bits(const SampleNumber& n) {
    const uint64_t h = n.hash();
    return static_cast<uint64_t>(digits(n, h)) << 32 | hash_combine(h, n.index) >> 32;
  }

 private:
  ETD_FN static uint32_t digits(const SampleNumber& n, uint64_t h) {
    return owen_sobol_x(shuffled_index(n.index, static_cast<uint32_t>(h)), static_cast<uint32_t>(h >> 32));
  }
};

}  // namespace etd
