// The random numbers of a path come from samplers. A number is a pure function of (seed, replicate, stream, index,
// dimension): any sample can be drawn alone, in any order, on any thread. A stream is a pixel or a light path.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "core/hash.h"
#include "core/tagged.h"
#include "core/vec.h"
#include "params/declaration.h"

namespace etd {

// The place of a number.
struct SampleNumber {
  uint64_t key = 0;  // of seed, replicate and stream
  uint32_t index = 0, dimension = 0;

  // This hash is the same for all indices.
  ETD_FN uint64_t hash() const { return hash_combine(key, dimension); }
};

// The 64 binary digits of a number, those of x before those of y. Each half is uniform, and so is all of it.
struct Digits {
  uint32_t x = 0, y = 0;
};

// The digits of consecutive dimensions, which a vector unit makes side by side.
struct DigitBlock {
  static constexpr uint32_t kSize = 8;
  std::array<uint32_t, kSize> x, y;
};

// What a kind of numbers promises.
struct SamplerTraits {
  bool stratified = false;  // in elementary intervals, over each aligned block of 2^m indices
};

// What kind of numbers: one of the list (sampler_list.h). It gives
//   Digits digits(n)                           uniform, in x and y together
//   void digits(n, DigitBlock& out), optional  the same of n's dimension and those behind it
class SamplerKind {
 public:
  // The default, sobol.
  SamplerKind();
  template <class T>
  explicit SamplerKind(const T& kind);

  std::string_view name() const;
  SamplerTraits traits() const;
  bool operator==(const SamplerKind& other) const { return name() == other.name(); }

 private:
  friend class Sampler;
  TaggedStorage<4, 4> storage_;
};

class Sampler {
 public:
  Sampler(SamplerKind kind, uint64_t seed) : kind_(kind), seed_(seed) {}

  // Selects the sample; the next number is of dimension 0.
  void start(uint64_t stream, uint32_t replicate, uint32_t index);
  // Jumps to a dimension, so that what a path vertex draws does not depend on what earlier vertices used.
  void set_dimension(uint32_t dimension) { next_.dimension = dimension; }
  // Makes the numbers of the DigitBlock::kSize dimensions from this one on, for who is about to draw several of them:
  // together they cost about as much as two. It changes no number.
  void fetch(uint32_t dimension);

  // Uniform in [0, 1). Each call of get_1d and get_2d uses one (padded) dimension.
  float get_1d() { return unit_float(advance().x); }
  Vec2 get_2d() {
    const Digits d = advance();
    return {unit_float(d.x), unit_float(d.y)};
  }
  // Does as get_1d, with all the bits of a double: for choosing one of many things.
  double get_choice() {
    const Digits d = advance();
    return static_cast<double>((static_cast<uint64_t>(d.x) << 32 | d.y) >> 11) * 0x1p-53;
  }
  // Well distributed in x and y together, z apart.
  Vec3 get_3d() {
    const Vec2 xy = get_2d();
    return {xy.x, xy.y, get_1d()};
  }
  // A key for the hash streams of stochastic closures: unique to this sample and `salt`.
  uint64_t key(uint64_t salt) const;

 private:
  static constexpr uint32_t kNone = 1u << 31;  // far behind every dimension

  Digits advance() {
    const uint32_t i = next_.dimension - fetched_;
    const Digits d = i < DigitBlock::kSize ? Digits{block_.x[i], block_.y[i]} : digits(next_);
    ++next_.dimension;
    return d;
  }
  Digits digits(const SampleNumber& n) const;

  SamplerKind kind_;
  uint64_t seed_;
  SampleNumber next_;
  uint32_t fetched_ = kNone;  // the first dimension of the block
  DigitBlock block_;
};

// The parameters of every sampler.
std::vector<ParamDecl> sampler_params();
std::span<const ModelDecl* const> sampler_models();
// The kind of that declared name; the default for an unknown one.
SamplerKind sampler_kind(std::string_view name);

}  // namespace etd
