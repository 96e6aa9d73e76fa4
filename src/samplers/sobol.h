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

  ETD_FN static Digits digits(const SampleNumber& n) {
    const uint64_t h = n.hash();
    const uint32_t i = shuffled_index(n.index, static_cast<uint32_t>(h));
    return {owen_sobol_x(i, static_cast<uint32_t>(h >> 32)), owen_sobol_y(i, static_cast<uint32_t>(mix_bits(h)))};
  }

  // Hashes need 64 bits and are made one by one; what follows are loops over lanes of 32.
  ETD_FN static void digits(SampleNumber n, DigitBlock& out) {
    constexpr uint32_t kSize = DigitBlock::kSize;
    uint32_t order[kSize], x[kSize], y[kSize];
    for (uint32_t lane = 0; lane < kSize; ++lane, ++n.dimension) {
      const uint64_t h = n.hash();
      order[lane] = static_cast<uint32_t>(h);
      x[lane] = static_cast<uint32_t>(h >> 32);
      y[lane] = static_cast<uint32_t>(mix_bits(h));
    }
    for (uint32_t lane = 0; lane < kSize; ++lane) {
      const uint32_t i = shuffled_index(n.index, order[lane]);
      out.x[lane] = owen_sobol_x(i, x[lane]);
      out.y[lane] = owen_sobol_y(i, y[lane]);
    }
  }
};

}  // namespace etd
