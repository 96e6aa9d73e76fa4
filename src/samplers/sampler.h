// The random numbers of a path come from samplers. A number is a pure function of (seed, replicate, stream, index,
// dimension): any sample can be drawn alone, in any order, on any thread. A stream is a pixel or a light path.
#pragma once

#include <span>

#include "core/vec.h"
#include "params/declaration.h"

namespace etd {

enum class SamplerKind : uint8_t { kIndependent, kSobol };

class Sampler {
 public:
  Sampler(SamplerKind kind, uint64_t seed) : kind_(kind), seed_(seed) {}

  // Selects the sample; the next number is of dimension 0.
  void start(uint64_t stream, uint32_t replicate, uint32_t index);
  // Jumps to a dimension, so that what a path vertex draws does not depend on what earlier vertices used.
  void set_dimension(uint32_t dimension) { dimension_ = dimension; }

  // Uniform in [0, 1). Each call of get_1d and get_2d uses one (padded) dimension.
  float get_1d();
  Vec2 get_2d();
  // Does as get_1d, with all the bits of a double: for choosing one of many things.
  double get_choice();
  // Well distributed in x and y together, z apart.
  Vec3 get_3d() {
    const Vec2 xy = get_2d();
    return {xy.x, xy.y, get_1d()};
  }
  // A key for the hash streams of stochastic closures: unique to this sample and `salt`.
  uint64_t key(uint64_t salt) const;

 private:
  SamplerKind kind_;
  uint64_t seed_;
  uint64_t key_ = 0;
  uint32_t index_ = 0, dimension_ = 0;
};

// Declarations of all samplers, and the kind that a declared name stands for.
std::span<const ModelDecl* const> sampler_models();
SamplerKind sampler_kind(std::string_view name);

}  // namespace etd
