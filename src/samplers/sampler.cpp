#include "samplers/sampler.h"

#include <array>

#include "core/hash.h"
#include "samplers/owen_sobol.h"

namespace etd {

void Sampler::start(uint64_t stream, uint32_t replicate, uint32_t index) {
  key_ = hash_combine(seed_, replicate, stream);
  index_ = index;
  dimension_ = 0;
}

float Sampler::get_1d() {
  const uint64_t h = hash_combine(key_, dimension_++);
  if (kind_ == SamplerKind::kIndependent) return unit_float(static_cast<uint32_t>(hash_combine(h, index_)));
  const uint32_t i = shuffled_index(index_, static_cast<uint32_t>(h));
  return unit_float(owen_sobol_x(i, static_cast<uint32_t>(h >> 32)));
}

double Sampler::get_choice() {
  const uint64_t h = hash_combine(key_, dimension_++);
  uint64_t bits = hash_combine(h, index_);
  if (kind_ == SamplerKind::kSobol) {
    // Behind the 32 digits that an index has, an Owen scramble is plain noise.
    const uint32_t i = shuffled_index(index_, static_cast<uint32_t>(h));
    bits = static_cast<uint64_t>(owen_sobol_x(i, static_cast<uint32_t>(h >> 32))) << 32 | bits >> 32;
  }
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

Vec2 Sampler::get_2d() {
  const uint64_t h = hash_combine(key_, dimension_++);
  if (kind_ == SamplerKind::kIndependent) {
    const uint64_t bits = hash_combine(h, index_);
    return {unit_float(static_cast<uint32_t>(bits)), unit_float(static_cast<uint32_t>(bits >> 32))};
  }
  const uint32_t i = shuffled_index(index_, static_cast<uint32_t>(h));
  return {unit_float(owen_sobol_x(i, static_cast<uint32_t>(h >> 32))),
          unit_float(owen_sobol_y(i, static_cast<uint32_t>(mix_bits(h))))};
}

uint64_t Sampler::key(uint64_t salt) const { return hash_combine(key_, index_, salt); }

namespace {

std::vector<ParamDecl> common_params() {
  return {{.name = "pixelsamples",
           .type = ParamType::kInteger,
           .default_value = 16,
           .min = 1,
           .max = 1 << 30,
           .doc = "Samples per pixel; rounded up to a multiple of the number of replicates."},
          {.name = "seed",
           .type = ParamType::kInteger,
           .default_value = 0,
           .doc = "Chooses another, equally good set of random numbers."}};
}

}  // namespace

std::span<const ModelDecl* const> sampler_models() {
  static const ModelDecl independent{Family::kSampler, "independent",
                                     "Every number independent of every other: the textbook Monte Carlo estimate.",
                                     common_params()};
  static const ModelDecl sobol{Family::kSampler, "sobol",
                               "Owen-scrambled Sobol points, padded pair by pair: the least error for equal samples.",
                               common_params()};
  static const std::array<const ModelDecl*, 2> all{&independent, &sobol};
  return all;
}

SamplerKind sampler_kind(std::string_view name) {
  return name == "independent" ? SamplerKind::kIndependent : SamplerKind::kSobol;
}

}  // namespace etd
