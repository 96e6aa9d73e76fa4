#include "samplers/sampler.h"

#include "params/model_list.h"
#include "samplers/sampler_list.h"

namespace etd {

SamplerKind::SamplerKind() : SamplerKind(SobolSampler()) {}

std::string_view SamplerKind::name() const {
  return dispatch<std::string_view, Samplers>(storage_,
                                              [](const auto& kind) -> std::string_view { return kind.decl().name; });
}

SamplerTraits SamplerKind::traits() const {
  return dispatch<SamplerTraits, Samplers>(storage_, [](const auto& kind) { return kind.kTraits; });
}

void Sampler::start(uint64_t stream, uint32_t replicate, uint32_t index) {
  next_.key = hash_combine(seed_, replicate, stream);
  next_.index = index;
  next_.dimension = 0;
  fetched_ = kNone;
}

Digits Sampler::digits(const SampleNumber& n) const {
  return dispatch<Digits, Samplers>(kind_.storage_, [&](const auto& kind) { return kind.digits(n); });
}

void Sampler::fetch(uint32_t dimension) {
  const SampleNumber n{next_.key, next_.index, dimension};
  fetched_ = dispatch<uint32_t, Samplers>(kind_.storage_, [&](const auto& kind) {
    if constexpr (requires { kind.digits(n, block_); })
      return kind.digits(n, block_), dimension;
    else
      return kNone;
  });
}

uint64_t Sampler::key(uint64_t salt) const { return hash_combine(next_.key, next_.index, salt); }

std::vector<ParamDecl> sampler_params() {
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

std::span<const ModelDecl* const> sampler_models() {
  static const std::vector<const ModelDecl*> all = declarations(Samplers{});
  return all;
}

SamplerKind sampler_kind(std::string_view name) {
  SamplerKind kind;
  with_named(Samplers{}, name, [&]<class T>(std::type_identity<T>) { kind = SamplerKind(T()); });
  return kind;
}

}  // namespace etd
